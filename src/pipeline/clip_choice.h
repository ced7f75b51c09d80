// SPDX-License-Identifier: MIT
// What commands on clips ask for: which clips, at which rate, from when to when.
// Test: tests/pipeline/transfer_test.cpp, tests/cli/cli_test.cpp
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "bake/bake.h"
#include "base/diagnostics.h"
#include "gltf/rig.h"

namespace rigc::pipeline {

/// Indices of the clips that are named, by name or number; all where none is.
std::optional<std::set<std::size_t>> choose_clips(const std::string& file,
                                                  const std::vector<std::string>& wanted,
                                                  const std::vector<anim::Clip>& clips,
                                                  Diagnostics& diagnostics);

/// glTF nodes of a rig that animators key: all but bones.
std::set<int> keyable_nodes(const gltf::Rig& rig);

/// Whether a clip has a channel on one of them.
bool keys_any(const anim::Clip& clip, const std::set<int>& keyable);

/// Frames a second: a number above 0, or 0 for `source`; reported where it is neither, or where the
/// range ends before it starts.
std::optional<double> read_rate(const std::string& file, const std::string& fps,
                                const std::optional<double>& start,
                                const std::optional<double>& end, Diagnostics& diagnostics);

/// Whether a tolerance is 0 or more millimetres; reported where it is not.
bool check_tolerance(const std::string& file, double mm, Diagnostics& diagnostics);

/// Where the joints of a rig stand in the file, as a bake takes it.
std::optional<std::vector<bake::Standing>> bake_standings(const gltf::File& file,
                                                          const gltf::Rig& rig,
                                                          Diagnostics& diagnostics);

}  // namespace rigc::pipeline
