// SPDX-License-Identifier: MIT
// The formulas of math/generic/trigonometry.h for one number. Test: tests/math/elementary_test.cpp
#include "math/generic/trigonometry.h"

namespace rigc::math {

double sqrt(double x) { return generic::sqrt(x); }
double sin(double radians) { return generic::sine_cosine(radians).sine; }
double cos(double radians) { return generic::sine_cosine(radians).cosine; }
double tan(double radians) {
  const auto both = generic::sine_cosine(radians);
  return both.sine / both.cosine;
}
double sin_degrees(double degrees) { return generic::sine_cosine_degrees(degrees).sine; }
double cos_degrees(double degrees) { return generic::sine_cosine_degrees(degrees).cosine; }
double tan_degrees(double degrees) { return generic::tan_degrees(degrees); }
double atan2(double y, double x) { return generic::atan2(y, x); }
double atan(double x) { return generic::atan2(x, 1.0); }
double asin(double x) { return generic::asin(x); }
double acos(double x) { return generic::acos(x); }

}  // namespace rigc::math
