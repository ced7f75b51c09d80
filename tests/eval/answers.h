// SPDX-License-Identifier: MIT
// Answers that are written out by hand, and how far rows are from them.
// Test: tests/eval/degenerate_test.cpp
#pragma once

#include <vector>

#include "tests/eval/twin_formulas.h"

namespace rigc::test {

inline constexpr double kTight = 1e-14;

inline math::Affine at(math::Vec3 p) { return {{}, p}; }
inline math::Affine turned(math::Vec3 axis, double degrees) {
  return math::rotation(math::axis_angle(axis, math::radians(degrees)));
}
inline exact::M turn_z(double degrees) { return exact::turn_degrees(2, degrees); }

inline double off(const std::vector<exact::Part>& want, const Numbers& got, double size = 1) {
  exact::Result result;
  result.parts = want;
  result.size = size;
  return static_cast<double>(exact::error_of(result, got));
}

}  // namespace rigc::test
