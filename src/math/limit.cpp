// SPDX-License-Identifier: MIT
// The formulas of math/generic/limits.h for one value. Test: tests/math/limit_test.cpp
#include "math/generic/limits.h"

namespace rigc::math {

LimitSpace::LimitSpace()
    : min{-generic::kNoBound, -generic::kNoBound, -generic::kNoBound},
      max{generic::kNoBound, generic::kNoBound, generic::kNoBound} {}

bool LimitSpace::bounded() const {
  for (std::size_t i = 0; i < 3; ++i)
    if (min[i] > -generic::kNoBound || max[i] < generic::kNoBound) return true;
  return false;
}

Vec3 limit_vector(Vec3 value, const LimitSpace& space) {
  return generic::limit_vector(value, space);
}
Quat limit_rotation(Quat value, const LimitSpace& space) {
  return generic::limit_rotation(value, space);
}

}  // namespace rigc::math
