// SPDX-License-Identifier: MIT
// Rigs of one file become one: their joints hang under one of its joints, their commands, nodes and
// templates join its own. Keys stay, because nodes keep their places in the file.
// Test: tests/pipeline/merge_into_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/patch.h"

namespace rigc::gltf {

/// What hangs under what.
struct Attach {
  std::string global;  ///< of the rig that joins; empty: the only other one that has the group
  std::string local;   ///< a local group of it: its root joint is meant
  std::string to_local, to_label;  ///< the joint that takes it
};

struct Joined {
  std::vector<std::string> rigs;  ///< global groups of those that joined
  std::size_t joints = 0, nodes = 0;
};

/// Joins the rigs that `attach` speaks of to the rig `into`. They rest where they rested, and
/// follow the joints that they are attached to. Every root joint of theirs is attached. Selectors
/// that name their global groups are the caller's to rename. `path`: the file, for messages.
std::optional<Joined> join_into(Patch& patch, const std::string& path, const std::string& into,
                                const std::vector<Attach>& attach, Diagnostics& diagnostics);

}  // namespace rigc::gltf
