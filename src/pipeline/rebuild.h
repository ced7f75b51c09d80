// SPDX-License-Identifier: MIT
// What a rig's own file is enough for: building again with other settings, taking the rig apart,
// out of the file, and letting orphans go. Test: tests/pipeline/rebuild_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "catalog/catalogue.h"
#include "pipeline/recompile.h"

namespace rigc::pipeline {

struct RebuildRequest : CarryOptions {
  std::vector<std::string> rigs;      ///< global groups; empty: all
  std::vector<std::string> features;  ///< [GROUP/]NAME[:SWITCH]=on|off, over those of the file
  std::vector<std::string> groups;    ///< GROUP=on|off
  std::string split_weights;          ///< on or off; empty: as the file was built
  std::string guides;                 ///< file of moved joints and edited controls; empty: none
  bool unbuild = false;               ///< skeleton and tags alone: keys become orphans
};

struct Rebuilt {
  std::vector<RigReport> rigs;
  std::uint64_t bytes = 0;
};

/// Builds the rigs of a file from the tags in it. Joints stay where the tags have them. Threads may
/// share the catalogue.
std::optional<Rebuilt> rebuild(const RebuildRequest& request, const catalog::Catalogue& catalogue,
                               const FileWork& work, Diagnostics& diagnostics);

struct Removed {
  std::vector<std::string> rigs;  ///< global groups
  std::size_t channels = 0;       ///< that went with them
  std::size_t orphans = 0;
  std::uint64_t bytes = 0;
};

/// Takes rigs and tags out of a file: of a model nothing but what it was remains; of a character
/// that came from a template its joints and proxy meshes.
std::optional<Removed> strip(const std::vector<std::string>& rigs, const FileWork& work,
                             Diagnostics& diagnostics);

/// Lets orphans go, with their keys.
std::optional<Removed> prune(const std::vector<std::string>& rigs, const FileWork& work,
                             Diagnostics& diagnostics);

}  // namespace rigc::pipeline
