// SPDX-License-Identifier: MIT
// Clamping of a vector along axes and of a rotation by its angles about axes. A value inside its
// bounds comes back bit for bit. Test: tests/math/limit_test.cpp
#pragma once

#include "math/math.h"

namespace rigc::math {

/// Bounds of three channels and what they are measured in. A side without a bound is infinite.
struct LimitSpace {
  Vec3 min, max;             ///< of a rotation: degrees about the axes
  Quat axes;                 ///< unit
  Vec3 origin;               ///< of a vector: what counts as 0
  Quat rest;                 ///< of a rotation: what counts as none; unit
  int order[3] = {0, 1, 2};  ///< of a rotation: axes that are turned about first, second and third,
                             ///< all fixed
  LimitSpace();              ///< no bounds
  bool bounded() const;      ///< whether any side has a bound
};

Vec3 limit_vector(Vec3 value, const LimitSpace& space);

/// Of the two triples of angles that are one rotation the one with the smaller sum counts; an angle
/// that has both bounds is taken by whole turns to where it violates them least.
Quat limit_rotation(Quat value, const LimitSpace& space);

}  // namespace rigc::math
