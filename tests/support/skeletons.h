// SPDX-License-Identifier: MIT
// What models do to a skeleton: other joint axes, other sizes, other facings, mirrored and scaled
// spaces. Each function changes a placed skeleton as if it had been fitted to such a model.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "math/math.h"
#include "tags/tags.h"

namespace rigc::test {

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  /// Below `end`, which is above 0.
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(engine_() % end); }
  double number(double low, double high);
  bool chance(double probability) { return number(0, 1) < probability; }
  math::Vec3 vector(double extent);
  math::Quat rotation();

 private:
  std::mt19937_64 engine_;
};

/// World matrices of all joints at rest.
std::vector<math::Affine> worlds(const tags::TaggedSkeleton& skeleton);

/// Sets the rests from world matrices.
void set_worlds(tags::TaggedSkeleton& skeleton, const std::vector<math::Affine>& worlds);

/// Turns the axes of every joint at random; no joint moves.
void turn_axes(tags::TaggedSkeleton& skeleton, std::uint64_t seed);

/// Moves the whole character by a similarity, a reflection too: joints, up, left, forward, sizes.
/// Joint frames stay right-handed, as exporters write them.
void transform(tags::TaggedSkeleton& skeleton, const math::Affine& by);

/// The first root joint gets this scale and everything under it shrinks to stay where it is.
void scale_root_joint(tags::TaggedSkeleton& skeleton, double scale);

/// The first root joint gets this scale and all below are scaled by it; every joint stays where it
/// is.
void scale_hierarchy(tags::TaggedSkeleton& skeleton, double scale);

/// A similarity: reflection at the plane across `mirror_axis` (or none: -1), scale, rotation.
math::Affine similarity(double scale, math::Quat rotation, int mirror_axis = -1);

}  // namespace rigc::test
