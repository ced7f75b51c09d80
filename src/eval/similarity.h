// SPDX-License-Identifier: MIT
// Matrices that turn and scale evenly, and no more: in their spaces rotations, means and distances
// are what they are in the world. Test: tests/eval/similarity_test.cpp
#pragma once

#include "math/math.h"

namespace rigc::eval {

/// Factors beyond these count for nothing: products of a few may overflow or vanish.
inline constexpr double kLeastScale = 1e-30, kMostScale = 1e30;

/// The factor s > 0 where `m` is s times a rotation, each entry to within 1e-12 s; else 0. A
/// factor within 1e-12 of 1 is 1.
double uniform_scale(const math::Mat3& m);

/// Whether the columns of `m` span a box that is not flat: at least 1e-6 of what they would at
/// right angles.
bool spans_space(const math::Mat3& m);

}  // namespace rigc::eval
