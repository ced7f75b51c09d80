// SPDX-License-Identifier: MIT
// Checks of constant matrices. Test: tests/eval/similarity_test.cpp
#include "eval/similarity.h"

#include <cmath>

namespace rigc::eval {

namespace {

constexpr double kTolerance = 1e-12;

bool near(double a, double b, double size) { return std::fabs(a - b) <= kTolerance * size; }

}  // namespace

double uniform_scale(const math::Mat3& m) {
  const double s = math::length(m.x);
  if (!(s >= kLeastScale && s <= kMostScale)) return 0;
  const bool equal = near(math::length(m.y), s, s) && near(math::length(m.z), s, s);
  const double square = s * s;
  const bool upright = near(dot(m.x, m.y), 0, square) && near(dot(m.y, m.z), 0, square) &&
                       near(dot(m.z, m.x), 0, square);
  if (!equal || !upright || !(math::determinant(m) > 0)) return 0;
  return near(s, 1, 1) ? 1 : s;
}

bool spans_space(const math::Mat3& m) {
  const math::Mat3 unit{math::normalised(m.x, {}), math::normalised(m.y, {}),
                        math::normalised(m.z, {})};
  return std::fabs(math::determinant(unit)) > 1e-6;
}

}  // namespace rigc::eval
