// SPDX-License-Identifier: MIT
// Kernels of formulas: numbers in, one number out; finite whatever comes in. What each means is in
// scene/formula.h. Test: tests/eval/numbers_test.cpp
#pragma once

#include "eval/kernels/lanes.h"
#include "math/generic/exponential.h"

namespace rigc::eval {
namespace {

// Overflow becomes the largest number, no number at all becomes 0.
template <class F>
struct Unary {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::finite(F::of(lanes.number(0))));
  }
};
template <class F>
struct Binary {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::finite(F::of(lanes.number(0), lanes.number(1))));
  }
};
template <class F>
struct Ternary {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::finite(F::of(lanes.number(0), lanes.number(1), lanes.number(2))));
  }
};

namespace numbers {

template <class C>
RIGC_INLINE Real truth(C condition) {
  return select(condition, Real(1.0), Real(0.0));
}

struct Negate {
  RIGC_INLINE static Real of(Real a) { return -a; }
};
struct Not {
  RIGC_INLINE static Real of(Real a) { return truth(a == 0.0); }
};
struct Add {
  RIGC_INLINE static Real of(Real a, Real b) { return a + b; }
};
struct Subtract {
  RIGC_INLINE static Real of(Real a, Real b) { return a - b; }
};
struct Multiply {
  RIGC_INLINE static Real of(Real a, Real b) { return a * b; }
};
struct Divide {
  RIGC_INLINE static Real of(Real a, Real b) {
    const auto none = b == 0.0;
    return select(none, Real(0.0), a / select(none, Real(1.0), b));
  }
};
/// The remainder is exact; it takes the divisor's sign.
struct Modulo {
  RIGC_INLINE static Real of(Real a, Real b) {
    const auto none = b == 0.0;
    const Real rest = math::remainder(a, select(none, Real(1.0), b));
    const auto crosses = truth(rest < 0.0) != truth(b < 0.0);
    const Real floored = select((rest != 0.0) & crosses, rest + b, rest);
    return select(none, Real(0.0), floored);
  }
};
struct Power {
  RIGC_INLINE static Real of(Real a, Real b) { return generic::pow(a, b); }
};
struct Less {
  RIGC_INLINE static Real of(Real a, Real b) { return truth(a < b); }
};
struct LessEqual {
  RIGC_INLINE static Real of(Real a, Real b) { return truth(a <= b); }
};
struct Greater {
  RIGC_INLINE static Real of(Real a, Real b) { return truth(a > b); }
};
struct GreaterEqual {
  RIGC_INLINE static Real of(Real a, Real b) { return truth(a >= b); }
};
struct Equal {
  RIGC_INLINE static Real of(Real a, Real b) { return truth(a == b); }
};
struct NotEqual {
  RIGC_INLINE static Real of(Real a, Real b) { return truth(a != b); }
};
struct And {
  RIGC_INLINE static Real of(Real a, Real b) { return truth((a != 0.0) & (b != 0.0)); }
};
struct Or {
  RIGC_INLINE static Real of(Real a, Real b) { return truth((a != 0.0) | (b != 0.0)); }
};
struct Select {
  RIGC_INLINE static Real of(Real a, Real b, Real c) { return select(a != 0.0, b, c); }
};
struct Sin {
  RIGC_INLINE static Real of(Real a) { return generic::sine_cosine_degrees(a).sine; }
};
struct Cos {
  RIGC_INLINE static Real of(Real a) { return generic::sine_cosine_degrees(a).cosine; }
};
struct Tan {
  RIGC_INLINE static Real of(Real a) { return generic::tan_degrees(a); }
};
struct Asin {
  RIGC_INLINE static Real of(Real a) { return generic::degrees(generic::asin(a)); }
};
struct Acos {
  RIGC_INLINE static Real of(Real a) { return generic::degrees(generic::acos(a)); }
};
struct Atan {
  RIGC_INLINE static Real of(Real a) { return generic::degrees(generic::atan2(a, Real(1.0))); }
};
struct Atan2 {
  RIGC_INLINE static Real of(Real a, Real b) { return generic::degrees(generic::atan2(a, b)); }
};
struct Sqrt {
  RIGC_INLINE static Real of(Real a) { return generic::sqrt(a); }
};
struct Abs {
  RIGC_INLINE static Real of(Real a) { return magnitude(a); }
};
struct Sign {
  RIGC_INLINE static Real of(Real a) { return truth(a > 0.0) - truth(a < 0.0); }
};
struct Floor {
  RIGC_INLINE static Real of(Real a) { return math::floored(a); }
};
struct Ceil {
  RIGC_INLINE static Real of(Real a) { return -math::floored(-a); }
};
/// Halves away from 0.
struct Round {
  RIGC_INLINE static Real of(Real a) {
    const Real size = magnitude(a), below = math::floored(size);
    return with_sign(below + truth(size - below >= 0.5), a);
  }
};
struct Exp {
  RIGC_INLINE static Real of(Real a) { return generic::exp(a); }
};
struct Log {
  RIGC_INLINE static Real of(Real a) { return select(a > 0.0, generic::log(a), Real(0.0)); }
};
struct Min {
  RIGC_INLINE static Real of(Real a, Real b) { return select(b < a, b, a); }
};
struct Max {
  RIGC_INLINE static Real of(Real a, Real b) { return select(b > a, b, a); }
};
struct Clamp {
  RIGC_INLINE static Real of(Real a, Real low, Real high) { return generic::clamped(a, low, high); }
};
struct Lerp {
  RIGC_INLINE static Real of(Real a, Real b, Real t) { return a + (b - a) * t; }
};
struct Smoothstep {
  RIGC_INLINE static Real of(Real low, Real high, Real x) {
    const auto apart = (low < high) | (low > high);
    const Real ratio = (x - low) / select(apart, high - low, Real(1.0));
    const Real t = generic::clamped(generic::finite(ratio), 0.0, 1.0);
    return select(apart, t * t * (3.0 - 2.0 * t), truth(x >= low));
  }
};
struct Hypot {
  RIGC_INLINE static Real of(Real a, Real b) { return generic::length(Vec3{a, b, Real(0.0)}); }
};

}  // namespace numbers
}  // namespace
}  // namespace rigc::eval
