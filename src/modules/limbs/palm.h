// SPDX-License-Identifier: MIT
// The hand at rest as geometry: where the palm faces, which way the fingers go, how each bone is
// bent already. Nothing of it comes from joint axes. Test: tests/modules/hand_test.cpp
#pragma once

#include <vector>

#include "modules/steps.h"

namespace rigc::modules {

/// A finger's joints that have controls, base to tip.
struct Finger {
  std::vector<NodeId> controls, joints;
  std::size_t knuckle = 0;        ///< first phalanx; what comes before is a metacarpal
  std::vector<math::Vec3> bones;  ///< unit directions, rig space
};

/// Unit directions, rig space.
struct Palm {
  math::Vec3 along;     ///< from the wrist to the knuckles
  math::Vec3 across;    ///< to the thumb's side, at right angles
  math::Vec3 inward;    ///< out of the palm: where the fingers close to
  math::Vec3 knuckles;  ///< their middle, a point
};

/// The last three joints are phalanges; of a finger with four or more the first are not, nor is a
/// first one that begins at the wrist. `wrist`: invalid for a thumb, which does begin there.
Finger finger_from(const Builder& b, const std::vector<NodeId>& controls, NodeId wrist = {});

/// Of a hand at the wrist with at least one finger, thumb's side first.
Palm palm_from(const Builder& b, NodeId wrist, const std::vector<Finger>& fingers);

/// Where a thumb bends to (unit): it lies beside the palm, and closes over it.
math::Vec3 thumb_inward(const Palm& palm);

/// The axis about which a finger bends, right-handed: the plane of its own bend where it has one
/// that agrees with the palm, else the palm's.
math::Vec3 bend_axis(const Finger& finger, math::Vec3 toward);

/// Degrees by which `bone` is bent from `before` about an axis.
double bend_between(math::Vec3 before, math::Vec3 bone, math::Vec3 axis);

/// How long a finger's n-th bone is, rig units. The last one, of which no joint says where it ends,
/// is a fifth shorter than the one before.
double bone_length(const Builder& b, const Finger& finger, std::size_t n);

/// Where the first of two bones points (unit) when the second ends at `goal`, or as near as they
/// reach: all from where the first begins. `bend`: where the joint between them bends out to.
math::Vec3 first_of_two(math::Vec3 goal, double first, double second, math::Vec3 bend);

}  // namespace rigc::modules
