// SPDX-License-Identifier: MIT
// The models that a rig must behave the same on, and how motion is compared between them.
#pragma once

#include <string>
#include <vector>

#include "support/pose.h"
#include "support/skeletons.h"

namespace rigc::test {

/// A change of a template's own skeleton, and the similarity that leads from its space to the
/// model's.
struct Model {
  std::string name;
  math::Affine by;
  Rig::Change change;
};

/// Joint axes turned at random, sizes of 100 and 0.01, facing -Z, mirrored, a scaled root joint,
/// and all together.
const std::vector<Model>& models();

/// A rotation of the template's space as it is in the model's.
math::Quat mapped(const math::Affine& by, math::Quat rotation);

/// What each joint does: world * rest world^-1, the same for every choice of its axes.
std::vector<math::Affine> motion(const Rig& rig, const Pose& pose);
/// A motion in the template's space as it is in the model's.
std::vector<math::Affine> mapped(const math::Affine& by, std::vector<math::Affine> motion);

/// Largest distance, in heights of the character, between where two motions bring the joints of a
/// rig and points around them.
double motion_difference(const Rig& rig, const std::vector<math::Affine>& a,
                         const std::vector<math::Affine>& b);

/// Makes the right side (`..._r`) the mirror image of the left as the parts of a template would:
/// opposite frames turned round, marked as mirrored.
void mirror_right_side(tags::TaggedSkeleton& skeleton);
/// The motion of each joint's opposite, reflected at the character's middle plane.
std::vector<math::Affine> mirror_image(const Rig& rig, const std::vector<math::Affine>& motion);

}  // namespace rigc::test
