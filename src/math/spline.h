// SPDX-License-Identifier: MIT
// The curve of math/generic/spline.h through points that stand still: where joints lie along it.
// Test: tests/math/spline_test.cpp
#pragma once

#include <vector>

#include "math/math.h"

namespace rigc::math {

/// Through two points or more. x = i is point i, in between the curve's own parameter; outside of
/// 0 .. number of points - 1 x counts as the nearer end.
class Spline {
 public:
  explicit Spline(std::vector<Vec3> points);

  Vec3 at(double x) const;
  /// Derivative by x.
  Vec3 slope(double x) const;
  /// Directions at the points, of length 1 or less (generic/spline.h); zero where all points meet.
  const std::vector<Vec3>& directions() const { return directions_; }
  /// How long the way from the start to x is, measured by straight pieces.
  double passed(double x) const;
  double length() const { return passed(static_cast<double>(points_.size() - 1)); }
  /// x of the place nearest to a point; of several the first.
  double nearest(Vec3 point) const;

 private:
  std::vector<Vec3> points_, directions_;
};

}  // namespace rigc::math
