// SPDX-License-Identifier: MIT
// URIs of buffers and images: percent-encoding, base64, data URIs. Test: tests/gltf/file_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rigc::gltf {

/// Percent-escapes resolved; nothing where one is broken, or where there is a zero byte.
std::optional<std::string> percent_decoded(std::string_view uri);

bool is_data_uri(std::string_view uri);
/// Has a scheme (`http:`) or starts at a root: not a path beside the file.
bool is_absolute_uri(std::string_view uri);
/// Bytes of a data URI, base64 or percent-encoded; nothing where it is broken.
std::optional<std::string> data_uri_bytes(std::string_view uri);

std::string base64(std::string_view bytes);
/// Strict: padded, no white space, no stray bits at the end; nothing otherwise.
std::optional<std::string> base64_decoded(std::string_view text);

}  // namespace rigc::gltf
