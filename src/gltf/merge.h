// SPDX-License-Identifier: MIT
// Several files in one: the first keeps every index and byte, what the others have is appended with
// every index as it is then. Test: tests/gltf/merge_test.cpp
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "gltf/file.h"
#include "gltf/patch.h"

namespace rigc::gltf {

struct MergeOptions {
  /// The output is a .glb: buffer 0 of every file, and those in data URIs, go into BIN.
  bool binary = true;
  bool join_clips = false;  ///< clips of one name become one clip
};

/// What came into the file.
struct Merged {
  std::size_t rigs = 0, nodes = 0, meshes = 0, clips = 0;
  /// By file: the files beside it that its buffers and images name, as relative paths. Those of the
  /// first are the patch's to tell.
  std::vector<std::vector<std::string>> copies;
};

/// Appends all that `files` but the first have to `patch`, which is one of the first. All files
/// must live, and the patch stay where it is, until it is finished. Roots of the others' default
/// scenes join the first file's default scene; their further scenes are appended. A rig whose id is
/// taken gets another. Errors: an extension that may hold unknown indices, two rigs with one global
/// group, a root extension that only one file can have.
std::optional<Merged> merge(Patch& patch, const std::deque<File>& files,
                            const MergeOptions& options, Diagnostics& diagnostics);

}  // namespace rigc::gltf
