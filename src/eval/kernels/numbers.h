// SPDX-License-Identifier: MIT
// Kernels of formulas: numbers in, one number out; finite whatever comes in. What each means is in
// scene/formula.h. Test: tests/eval/numbers_test.cpp
#pragma once

#include "eval/kernels/call.h"

namespace rigc::eval::numbers {

void negate(const Call& call);
void logical_not(const Call& call);
void add(const Call& call);
void subtract(const Call& call);
void multiply(const Call& call);
void divide(const Call& call);
void modulo(const Call& call);
void power(const Call& call);
void less(const Call& call);
void less_equal(const Call& call);
void greater(const Call& call);
void greater_equal(const Call& call);
void equal(const Call& call);
void not_equal(const Call& call);
void logical_and(const Call& call);
void logical_or(const Call& call);
void select(const Call& call);
void sin(const Call& call);
void cos(const Call& call);
void tan(const Call& call);
void asin(const Call& call);
void acos(const Call& call);
void atan(const Call& call);
void atan2(const Call& call);
void sqrt(const Call& call);
void abs(const Call& call);
void sign(const Call& call);
void floor(const Call& call);
void ceil(const Call& call);
void round(const Call& call);
void exp(const Call& call);
void log(const Call& call);
void min(const Call& call);
void max(const Call& call);
void clamp(const Call& call);
void lerp(const Call& call);
void smoothstep(const Call& call);
void hypot(const Call& call);

}  // namespace rigc::eval::numbers
