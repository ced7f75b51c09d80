// SPDX-License-Identifier: MIT
// Lengths and directions of vectors, also of vectors whose squares overflow or vanish.
// Test: tests/math/vector_test.cpp
#include <cmath>

#include "math/math.h"

namespace rigc::math {

namespace {

double largest_component(Vec3 a) {
  const double x = std::fabs(a.x), y = std::fabs(a.y), z = std::fabs(a.z);
  const double xy = x > y ? x : y;
  return xy > z ? xy : z;
}

}  // namespace

double length(Vec3 a) {
  const double squares = dot(a, a);
  if (squares > 1e-280 && squares < 1e300) return std::sqrt(squares);
  const double largest = largest_component(a);
  if (!(largest > 0)) return 0;
  const Vec3 small{a.x / largest, a.y / largest, a.z / largest};
  return largest * std::sqrt(dot(small, small));
}

Vec3 normalised(Vec3 a, Vec3 fallback) {
  const double size = length(a);
  if (!(size >= 1e-30)) return fallback;
  return {a.x / size, a.y / size, a.z / size};
}

Vec3 perpendicular(Vec3 a) {
  const double x = std::fabs(a.x), y = std::fabs(a.y), z = std::fabs(a.z);
  // The axis that `a` leans to least, so that the product is never short.
  const Vec3 axis = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  return normalised(cross(a, axis), {0, 1, 0});
}

}  // namespace rigc::math
