// SPDX-License-Identifier: MIT
// A chain of three joints as the two-bone solver sees it: shared by ik_handle and ik_fk_limb; and
// where a straight chain bends to.
// Test: tests/modules/ik_test.cpp
#pragma once

#include <string>

#include "modules/steps.h"

namespace rigc::modules {

struct TwoBone {
  NodeId start, middle, end;
  math::Vec3 bend;    ///< unit, rig space, at right angles to start -> end: where the middle joint
                      ///< bends out to
  double length = 0;  ///< upper and lower bone, rig units
  /// Degrees about start -> end from `bend` to the side on which the middle joint rests: not 0
  /// where a nearly straight limb rests bent to another side than it shall bend to.
  double swivel = 0;
};

/// Measures the bend at rest. `bend` is the parameter: auto, forward, backward, left, right, up,
/// down. A limb bent by 5 degrees or more keeps its plane; a straighter one bends where the
/// parameter says (auto: backward for limbs that reach sideways, else forward), in its own plane
/// where that agrees; else it swivels there from where it rests while it bends. Fails on bones of
/// no length.
TwoBone measure_two_bone(Builder& b, NodeId start, NodeId middle, NodeId end,
                         const std::string& bend);

/// Axes of an FK control of the middle joint: x along its bone (`direction`, unit, rig space), z at
/// right angles to the limb's plane, so that the limb bends about z alone. y points to the side
/// that bone_frame's does.
math::Mat3 hinge_frame(const Builder& b, const TwoBone& limb, math::Vec3 direction);

/// Adds to degrees by which the solver turns a bone about itself (kStartTwist, kMiddleTwist), or
/// the limb (kTwist).
void add_turn(Builder& b, const Plug& turn, const Plug& degrees);

/// Where the pole rests so that the limb stays where it is.
math::Vec3 pole_position(const Builder& b, const TwoBone& limb, double distance);

/// The solver node with everything connected. Without a pole (invalid) the limb keeps the bend of
/// its rest pose with what it hangs on.
NodeId make_two_bone(Builder& b, const TwoBone& limb, NodeId goal, NodeId pole,
                     double twist_degrees);

/// Where an exactly straight chain of three or more joints bends to when it has no pole: a
/// transform on the side that `bend` names. Invalid for a chain that is bent at rest, which keeps
/// its bend.
NodeId straight_chain_pole(Builder& b, const std::vector<NodeId>& chain, const std::string& bend);

}  // namespace rigc::modules
