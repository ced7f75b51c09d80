// SPDX-License-Identifier: MIT
// Lets a control follow another space without moving: the switch is keyed, and the control so that
// it stays where it was. Test: tests/pipeline/match_space_test.cpp
#pragma once

#include "bake/match.h"

namespace rigc::bake {

/// What the rig says about a control that can follow several spaces (scene::spaces).
struct SpaceSwitch {
  struct Attributes {
    scene::Plug number;               ///< 0 is the first
    std::vector<scene::Plug> shares;  ///< by space: how much it counts beside that
  };
  scene::NodeId control;
  std::vector<std::string> spaces;   ///< names, in the order of their numbers
  std::vector<Attributes> switches;  ///< one, or one for place and one for rotation
};

/// Nothing where the rig names no spaces for the control, or not completely.
std::optional<SpaceSwitch> find_spaces(const scene::Scene& scene, scene::NodeId control);

/// As solve_match. `space`: number of the one to follow. The
/// control's translation and rotation are solved; its scale stays.
std::optional<Matched> solve_space(const scene::Scene& scene, const std::vector<int>& nodes,
                                   const anim::Clip& clip, const SpaceSwitch& spaces,
                                   std::size_t space, const MatchOptions& options,
                                   Diagnostics& diagnostics);

}  // namespace rigc::bake
