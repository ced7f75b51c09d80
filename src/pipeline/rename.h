// SPDX-License-Identifier: MIT
// Rename: another global group for a rig of a file. Test: tests/pipeline/rename_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

struct RenameRequest {
  std::string file;
  std::vector<std::string> globals;  ///< OLD=NEW, all at once: names may change places
  Paths paths;                       ///< modules say which arguments are selectors
};

struct Renamed {
  std::size_t rigs = 0;
  std::size_t selectors = 0;  ///< arguments of commands that named a rig
  bool changed = false;       ///< else nothing was written
};

/// Changes RIGC_rig alone, at the places that have the names. `out` empty: the file itself, which
/// is locked meanwhile.
std::optional<Renamed> rename_rigs(const RenameRequest& request, const std::string& out,
                                   Diagnostics& diagnostics);

}  // namespace rigc::pipeline
