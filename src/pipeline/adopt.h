// SPDX-License-Identifier: MIT
// Adopt: what was edited in an application that drops extensions comes back into the rig file, by
// what the nodes say that they are (extras.rigc), never by their names. Test:
// tests/pipeline/adopt_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

struct AdoptRequest {
  std::string edited;              ///< comes from the application
  std::string original;            ///< the rig file that went into it
  std::vector<std::string> clips;  ///< names in the edited file; empty: all
  bool skeleton = false;           ///< take placements of joints too, and build the rig on them
  Paths paths;                     ///< modules
};

/// What became of a clip of the edited file.
struct AdoptedClip {
  std::string name;              ///< in the result
  bool fresh = false;            ///< new: the original had none of that name
  std::size_t changed = 0;       ///< channels that replace the original's
  std::size_t added = 0;         ///< channels that the original's clip did not have
  std::size_t same = 0;          ///< channels that play as the original's, which stay
  std::size_t at_rest = 0;       ///< channels that only hold what their control has unkeyed
  std::size_t kept = 0;          ///< the original's channels on controls that the other lost: stay
  std::size_t not_controls = 0;  ///< channels on nodes that are no controls: not taken
};

struct Adopted {
  std::vector<AdoptedClip> clips;
  std::size_t transforms = 0;  ///< controls that were moved without a key
  std::size_t attributes = 0;  ///< attributes that were set without a key
  std::size_t joints = 0;      ///< joints with another placement
  std::size_t unknown = 0;     ///< identities that the original does not have
  std::uint64_t bytes = 0;
};

/// Writes the original with what was edited. Placements of joints go into the rig's tags and to the
/// joints' nodes, and the rigs are built again so that controls follow.
std::optional<Adopted> adopt(const AdoptRequest& request, const std::string& out,
                             Diagnostics& diagnostics);

}  // namespace rigc::pipeline
