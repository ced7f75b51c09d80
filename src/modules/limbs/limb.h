// SPDX-License-Identifier: MIT
// The limb that an ik_fk_limb command built, for commands that add to it. What each part is driven
// by may have changed since: read it with now(), put something between with Builder::reconnect.
// Test: tests/modules/limb_stretch_test.cpp
#pragma once

#include <array>
#include <string_view>

#include "modules/made.h"

namespace rigc::modules {

struct LimbParts {
  std::array<NodeId, 3> joints;  ///< start, middle, end
  std::array<NodeId, 3> fk;      ///< FK controls
  NodeId ik, pole, settings;     ///< controls
  NodeId goal;                   ///< transform under the IK control: where the end joint goes and
                                 ///< how it turns in IK; hang it elsewhere to move the goal
  NodeId solver;                 ///< ik_two_bone
  std::array<NodeId, 3> blends;  ///< orient constraints of the joints: target 0 FK, 1 IK
  Plug ik_weight, fk_weight;     ///< numbers 0..1
  NodeId match;                  ///< what programs read that carry poses between FK and IK
};

/// The limb that a node parameter names by anything that its command made. Reports kNoLimb at the
/// parameter where that is no limb; check failed() then.
LimbParts limb_from(Builder& b, std::string_view parameter);
/// The same for one of the nodes that a parameter names.
LimbParts limb_of(Builder& b, NodeId named, std::string_view parameter);

/// What hangs directly under a control and carries the goal of a limb; invalid where the goal does
/// not hang below that control.
NodeId carrier_below(const Builder& b, NodeId control, const LimbParts& limb);

}  // namespace rigc::modules
