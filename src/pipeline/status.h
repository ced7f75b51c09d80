// SPDX-License-Identifier: MIT
// Status: what made the rigs of files, what is newer now, and what an update would do. Files are
// read only as far as that needs, several at a time. Test: tests/cli/status_test.cpp
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "gltf/rig_summary.h"
#include "pipeline/assess.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

struct StatusRequest {
  std::vector<std::string> inputs;  ///< FILE, DIR, 'PATTERN', @LIST: see find_inputs()
  std::size_t jobs = 0;             ///< files at a time; 0: as many as the machine has processors
  Paths paths;
};

struct RigStatus {
  gltf::RigSummary rig;
  Assessment assessment;
};

struct FileStatus {
  std::string file;
  bool read = false;  ///< false: it has errors, which were reported
  std::vector<RigStatus> rigs;
};

/// In the order of the inputs; nothing where they or modules have errors.
std::optional<std::vector<FileStatus>> status(const StatusRequest& request,
                                              Diagnostics& diagnostics);

/// Whether an update would change any rig.
bool any_changes(const std::vector<FileStatus>& files);

/// One line for each rig, its orphans below, and a summary.
std::string status_text(const std::vector<FileStatus>& files);
std::string status_json(const std::vector<FileStatus>& files);

}  // namespace rigc::pipeline
