// SPDX-License-Identifier: MIT
// A two-bone limb backwards: from how its joints are turned to where its goal and its pole are.
// Test: tests/bake/transfer_test.cpp
#pragma once

#include "math/math.h"

namespace rigc::bake {

/// A limb as its solver sees it (scene/kinds.h, ik2), before it is solved.
struct Limb {
  math::Affine base;
  math::Vec3 start, middle, end;  ///< translations of the joints, each in its parent's space
  math::Vec3 start_scale, middle_scale;
};

/// Where a solved limb lies, rig space.
struct Bones {
  math::Vec3 start, middle, end;         ///< as the solver counts them
  math::Vec3 first, second;              ///< directions of the bones, unit vectors
  math::Vec3 first_child, second_child;  ///< the same in the joints' own axes
};

/// The bones that turn start and middle joint as their worlds are turned. The solver gives these
/// back for a goal at `end` and a pole in their plane, but for turns about the bones.
Bones bones_of(const Limb& limb, const math::Affine& start, const math::Affine& middle);

/// The translation of the goal's control as 32-bit floats: of those around the exact one that with
/// which start and end are as far apart as the bones say. The middle of a limb that is nearly
/// straight moves by the root of an error in that distance: of one that is exactly straight or
/// folded the goal is such that it stays so. `to_point`: from a translation to the
/// point that the limb's end is to reach.
math::Vec3 rounded_goal(const Bones& bones, const math::Affine& to_point);

/// The side of the line from start to end on which the middle joint lies, a unit vector at right
/// angles to it. A limb that is straight within rounding bends to where the start's joint says;
/// `bone_offset`: its rest rotation seen from the bone's frame, whose z is normal to the plane.
math::Vec3 bent_side(const Bones& bones, const math::Affine& start, math::Quat bone_offset);

/// Degrees, above -180 up to 180, by which a joint of the limb is turned about its bone against the
/// solver's own frame there. `bone`, `child`: of Bones; `side`: bent_side(); `joint_offset`: the
/// joint's rest rotation seen from its bone's frame.
double twist_of(const Bones& bones, math::Vec3 side, math::Vec3 bone, math::Vec3 child,
                math::Quat joint_offset, const math::Affine& joint);

}  // namespace rigc::bake
