// SPDX-License-Identifier: MIT
// The formulas of math/generic/exponential.h for one number. Test: tests/math/elementary_test.cpp
#include "math/generic/exponential.h"

namespace rigc::math {

double exp(double x) { return generic::exp(x); }
double log(double x) { return generic::log(x); }
double pow(double x, double y) { return generic::pow(x, y); }
double cbrt(double x) { return generic::cbrt(x); }

}  // namespace rigc::math
