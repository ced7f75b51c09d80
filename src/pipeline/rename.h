// SPDX-License-Identifier: MIT
// Rename: another global group for a rig of a file. Test: tests/pipeline/rename_test.cpp
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "gltf/patch.h"
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

/// Lets selectors in the arguments of every rig of a patch name other rigs: pairs of old and new.
/// Gives how many arguments changed.
std::size_t rename_selectors(gltf::Patch& patch, const std::map<std::string, std::string>& names,
                             const catalog::Catalogue& catalogue);

}  // namespace rigc::pipeline
