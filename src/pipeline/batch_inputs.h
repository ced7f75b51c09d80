// SPDX-License-Identifier: MIT
// The files that arguments mean: FILE, DIR, 'PATTERN', @LIST. Test:
// tests/pipeline/batch_inputs_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"

namespace rigc::pipeline {

struct BatchInput {
  std::string path;   ///< as the user gave it, with what was found below it
  std::string below;  ///< its place below the folder or pattern that named it; else its name
};

/// Every file once, even if several arguments or symbolic links lead to it, in the order of the
/// arguments and sorted below each. A folder is searched for .glb, .gltf and .vrm; hidden names and
/// the folders `left_out` are skipped. In a pattern `*`, `?` and `[a-z]` stand for parts of a name
/// and `**` for any folders; a path that is there is never taken for a pattern. Lines of a list are
/// paths from the list's folder on; empty ones and those that begin with # are skipped. A named
/// file that is not there is no error here. An argument that finds nothing is.
std::optional<std::vector<BatchInput>> find_inputs(const std::vector<std::string>& arguments,
                                                   const std::vector<std::string>& left_out,
                                                   Diagnostics& diagnostics);

}  // namespace rigc::pipeline
