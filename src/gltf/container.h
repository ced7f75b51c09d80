// SPDX-License-Identifier: MIT
// The container of a file: a .glb's header and chunks, or bare JSON. Test: tests/gltf/file_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"

namespace rigc::gltf {

/// Of a file, in bytes.
inline constexpr std::uint64_t kLargestFile = std::uint64_t{8} << 30;

/// Parts of the file's bytes.
struct Container {
  bool binary = false;
  Bytes json;
  std::size_t json_offset = 0;      ///< of `json` in the file
  std::optional<Bytes> bin;         ///< with its padding
  std::vector<Bytes> other_chunks;  ///< header and bytes
};

/// A file that begins with `glTF` is binary, every other one is JSON, whatever it is called. JSON
/// that is too large to parse is reported.
std::optional<Container> read_container(const Bytes& whole, const std::string& path,
                                        Diagnostics& diagnostics);

}  // namespace rigc::gltf
