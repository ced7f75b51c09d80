// SPDX-License-Identifier: MIT
// Merge: several files in one. Test: tests/pipeline/merge_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "gltf/merge.h"
#include "gltf/merge_into.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

struct MergeRequest {
  std::vector<std::string> files;   ///< the first keeps every index
  bool join_clips = false;          ///< clips of one name become one clip
  std::string into;                 ///< global group of the rig that others join; empty: none do
  std::vector<std::string> attach;  ///< [GLOBAL:]LOCAL=LOCAL.LABEL
  Paths paths;                      ///< modules say which arguments are selectors
};

struct MergedFile {
  gltf::Merged merged;
  gltf::Joined joined;
  std::uint64_t bytes = 0;
};

/// Writes `out` (.glb or .gltf). Nothing is written where anything failed.
std::optional<MergedFile> merge_files(const MergeRequest& request, const std::string& out,
                                      Diagnostics& diagnostics);

}  // namespace rigc::pipeline
