// SPDX-License-Identifier: MIT
// The container of a file: a .glb's header and chunks, or bare JSON. Test: tests/gltf/file_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

namespace rigc::gltf {

/// Views into the file's bytes.
struct Container {
  bool binary = false;
  std::string_view json;
  std::size_t json_offset = 0;  ///< of `json` in the file
  std::string_view bin;         ///< with its padding; data() is null without a BIN chunk
  std::vector<std::string_view> other_chunks;  ///< header and bytes
};

/// A file that begins with `glTF` is binary, every other one is JSON, whatever it is called.
std::optional<Container> read_container(std::string_view whole, const std::string& path,
                                        Diagnostics& diagnostics);

}  // namespace rigc::gltf
