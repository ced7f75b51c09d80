// SPDX-License-Identifier: MIT
// The geometry of chain IK: points with fixed distances that shall reach a goal.
// Test: tests/eval/chain_test.cpp
#pragma once

#include <array>

#include "math/math.h"

namespace rigc::eval::chain {

/// The most joints that a chain has; checked when a program is compiled.
inline constexpr int kMaxJoints = 256;

struct Points {
  int count = 0;
  std::array<math::Vec3, kMaxJoints> at;
  std::array<double, kMaxJoints> lengths;  ///< lengths[i]: from at[i] to at[i + 1]
};

/// `v` at unit length, or where it is shorter than rounding noise of the chain its first bone's
/// direction.
math::Vec3 direction(const Points& points, math::Vec3 v);

/// The unit part of `v` at right angles to `axis`; zero where there is none.
math::Vec3 across(math::Vec3 v, math::Vec3 axis);

/// Where the joints between bend out to, seen from unit vector `along`: unit, or zero for a
/// straight chain.
math::Vec3 bend_of(const Points& points, math::Vec3 along);

/// Moves all points but the first so that the last is at the goal; exactly straight where it is out
/// of reach. A straight chain that must bend bends toward unit vector `bend`.
void reach(Points& points, math::Vec3 goal, math::Vec3 bend, int iterations);

}  // namespace rigc::eval::chain
