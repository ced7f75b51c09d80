// SPDX-License-Identifier: MIT
// The formulas of math/generic/vectors.h for one vector. Test: tests/math/vector_test.cpp
#include "math/generic/vectors.h"

namespace rigc::math {

double length(Vec3 a) { return generic::length(a); }
Vec3 normalised(Vec3 a, Vec3 fallback) { return generic::normalised(a, fallback); }
Vec3 perpendicular(Vec3 a) { return generic::perpendicular(a); }

}  // namespace rigc::math
