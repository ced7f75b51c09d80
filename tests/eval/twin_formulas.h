// SPDX-License-Identifier: MIT
// The scalar twins of transforms and of formulas, in long double; what a formula means is in
// scene/formula.h. Test: tests/eval/twins_test.cpp
#pragma once

#include <functional>

#include "tests/eval/twin_solvers.h"
#include "tests/eval/twin_spline.h"
#include "tests/eval/twin_vectors.h"

namespace rigc::exact {

inline Result compose(const Arguments& a, const Numbers&) {
  const V scale = vector_at(a, 2);
  Result out;
  out.parts = {A(scaled(turn(std::get<math::Quat>(a[1])), scale), vector_at(a, 0))};
  return out;
}

inline Result compose_rigid(const Arguments& a, const Numbers&) {
  Result out;
  out.parts = {A(turn(std::get<math::Quat>(a[1])), vector_at(a, 0))};
  return out;
}

inline Result compose_under(const Arguments& a, const Numbers& d) {
  const M above = turn(quat_at(d, 3));
  Result out;
  out.parts = {
      A(above * turn(std::get<math::Quat>(a[1])), above * vector_at(a, 0) + vec3_at(d, 0))};
  out.size = length(vector_at(a, 0)) + length(vec3_at(d, 0));
  return out;
}

/// `own` by the linear part of one matrix, its origin by another.
inline Result hung(const A& parent, const A& turned, const A& own) {
  Result out;
  out.parts = {A(turned.linear * own.linear, parent * own.origin)};
  out.condition = condition_of(turned.linear);
  Real most = 0;
  for (std::size_t i = 0; i < 3; ++i) most = fmaxl(most, length(parent.linear[i]));
  out.size = most * length(own.origin) + length(parent.origin);
  return out;
}

inline Result hang(const Arguments& a, const Numbers& d) {
  return hung(matrix_at(a, 0), matrix_at(a, 1), {matrix_at(d, 0), vec3_at(d, 9)});
}

inline Result hang_straight(const Arguments& a, const Numbers& d) {
  return hung(matrix_at(a, 0), matrix_at(a, 1), {M{}, vec3_at(d, 0)});
}

inline Result place(const Arguments& a, const Numbers&) {
  return hung(matrix_at(a, 0), matrix_at(a, 1), {M{}, vector_at(a, 2)});
}

inline Result multiply(const Arguments& a, const Numbers&) {
  const A left = matrix_at(a, 0), right = matrix_at(a, 1);
  Result out;
  out.parts = {left * right};
  // Sums of products that cancel.
  out.condition = condition_of(left.linear);
  Real most = 0;
  for (std::size_t i = 0; i < 3; ++i) most = fmaxl(most, length(left.linear[i]));
  out.size = most * length(right.origin) + length(left.origin);
  return out;
}

inline Result gather(const Arguments& a, const Numbers&) {
  Result out;
  out.parts = {number_at(a, 0), vector_at(a, 1), number_at(a, 2)};
  return out;
}

inline Result from_euler(const Arguments& a, const Numbers&) {
  const V degrees = vector_at(a, 0);
  Result out;
  out.parts = {turn_degrees(2, degrees.z) * turn_degrees(1, degrees.y) *
               turn_degrees(0, degrees.x)};
  return out;
}

inline Result to_euler(const Arguments& a, const Numbers&) {
  Result out;
  out.parts = {Angles{turn(std::get<math::Quat>(a[0]))}};
  return out;
}

inline Real truth(bool condition) { return condition ? 1.0L : 0.0L; }

inline Real power(Real a, Real b) {
  if (b == 0 || a == 1) return 1;
  if (a == 0 || (a < 0 && floorl(b) != b)) return 0;
  return powl(a, b);
}

/// Of the divisor's sign.
inline Real modulo(Real a, Real b) {
  if (b == 0) return 0;
  const Real rest = fmodl(a, b);
  return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

inline Real smoothstep(Real low, Real high, Real x) {
  if (low == high) return truth(x >= low);
  const Real t = std::clamp((x - low) / (high - low), 0.0L, 1.0L);
  return t * t * (3 - 2 * t);
}

/// Whole quarter turns are taken off first, which is exact.
inline Real sine(Real degrees, int quarters) {
  const Real rest = fmodl(degrees, 360), turns = roundl(rest / 90);
  const Real angle = (rest - 90 * turns) * kDegree;
  const int quarter = (static_cast<int>(turns) + quarters + 8) % 4;
  const Real value = quarter % 2 == 1 ? cosl(angle) : sinl(angle);
  return quarter >= 2 ? -value : value;
}

/// 0 at odd quarter turns.
inline Real tangent(Real degrees) {
  return fmodl(fabsl(degrees), 180) == 90 ? 0 : sine(degrees, 0) / sine(degrees, 1);
}

using Formula = std::function<Real(Real, Real, Real)>;

/// Empty for what is no formula.
inline Formula formula(eval::Op op) {
  using eval::Op;
  switch (op) {
    case Op::negate:
      return [](Real a, Real, Real) { return -a; };
    case Op::logical_not:
      return [](Real a, Real, Real) { return truth(a == 0); };
    case Op::add:
      return [](Real a, Real b, Real) { return a + b; };
    case Op::subtract:
      return [](Real a, Real b, Real) { return a - b; };
    case Op::multiply_numbers:
      return [](Real a, Real b, Real) { return a * b; };
    case Op::divide:
      return [](Real a, Real b, Real) { return b == 0 ? 0 : a / b; };
    case Op::modulo:
      return [](Real a, Real b, Real) { return modulo(a, b); };
    case Op::power:
      return [](Real a, Real b, Real) { return power(a, b); };
    case Op::less:
      return [](Real a, Real b, Real) { return truth(a < b); };
    case Op::less_equal:
      return [](Real a, Real b, Real) { return truth(a <= b); };
    case Op::greater:
      return [](Real a, Real b, Real) { return truth(a > b); };
    case Op::greater_equal:
      return [](Real a, Real b, Real) { return truth(a >= b); };
    case Op::equal:
      return [](Real a, Real b, Real) { return truth(a == b); };
    case Op::not_equal:
      return [](Real a, Real b, Real) { return truth(a != b); };
    case Op::logical_and:
      return [](Real a, Real b, Real) { return truth(a != 0 && b != 0); };
    case Op::logical_or:
      return [](Real a, Real b, Real) { return truth(a != 0 || b != 0); };
    case Op::select:
      return [](Real a, Real b, Real c) { return a != 0 ? b : c; };
    case Op::sin:
      return [](Real a, Real, Real) { return sine(a, 0); };
    case Op::cos:
      return [](Real a, Real, Real) { return sine(a, 1); };
    case Op::tan:
      return [](Real a, Real, Real) { return tangent(a); };
    case Op::asin:
      return [](Real a, Real, Real) { return asinl(std::clamp(a, -1.0L, 1.0L)) / kDegree; };
    case Op::acos:
      return [](Real a, Real, Real) { return acosl(std::clamp(a, -1.0L, 1.0L)) / kDegree; };
    case Op::atan:
      return [](Real a, Real, Real) { return atanl(a) / kDegree; };
    case Op::atan2:
      return [](Real a, Real b, Real) { return atan2l(a, b) / kDegree; };
    case Op::sqrt:
      return [](Real a, Real, Real) { return a > 0 ? sqrtl(a) : 0; };
    case Op::abs:
      return [](Real a, Real, Real) { return fabsl(a); };
    case Op::sign:
      return [](Real a, Real, Real) { return truth(a > 0) - truth(a < 0); };
    case Op::floor:
      return [](Real a, Real, Real) { return floorl(a); };
    case Op::ceil:
      return [](Real a, Real, Real) { return ceill(a); };
    case Op::round:
      return [](Real a, Real, Real) { return roundl(a); };
    case Op::exp:
      return [](Real a, Real, Real) { return expl(a); };
    case Op::log:
      return [](Real a, Real, Real) { return a > 0 ? logl(a) : 0; };
    case Op::min:
      return [](Real a, Real b, Real) { return fminl(a, b); };
    case Op::max:
      return [](Real a, Real b, Real) { return fmaxl(a, b); };
    case Op::clamp:
      return [](Real a, Real b, Real c) { return fminl(fmaxl(a, b), c); };
    case Op::lerp:
      return [](Real a, Real b, Real c) { return a + (b - a) * c; };
    case Op::smoothstep:
      return [](Real a, Real b, Real c) { return smoothstep(a, b, c); };
    case Op::hypot:
      return [](Real a, Real b, Real) { return hypotl(a, b); };
    default:
      return {};
  }
}

/// The twin of any operation.
inline Result twin_of(eval::Op op, const Arguments& a, const Numbers& d) {
  using eval::Op;
  if (const Formula f = formula(op)) {
    Real x[3] = {0, 0, 0};
    for (std::size_t i = 0; i < a.size(); ++i) x[i] = number_at(a, i);
    Result out;
    const Real value = f(x[0], x[1], x[2]);
    out.parts = {value};
    out.size = fmaxl(fabsl(value), 1e-300L);
    // What cancels.
    if (op == Op::lerp) out.size += fabsl(x[0]) + fabsl((x[1] - x[0]) * x[2]);
    if (op == Op::smoothstep) {
      const Real range = fabsl(x[1] - x[0]);
      if (range > 0) out.size += (fabsl(x[0]) + fabsl(x[2])) / range * fminl(1, value * 3);
    }
    return out;
  }
  if (test::is_vector_formula(op)) return vector_formula(op, a);
  switch (op) {
    case Op::compose:
      return compose(a, d);
    case Op::compose_rigid:
      return compose_rigid(a, d);
    case Op::compose_under:
      return compose_under(a, d);
    case Op::hang:
      return hang(a, d);
    case Op::hang_straight:
      return hang_straight(a, d);
    case Op::place:
      return place(a, d);
    case Op::blend:
      return blend(a, d);
    case Op::aim_world:
      return aim_world(a, d);
    case Op::multiply:
      return multiply(a, d);
    case Op::gather:
      return gather(a, d);
    case Op::from_euler:
      return from_euler(a, d);
    case Op::to_euler:
      return to_euler(a, d);
    case Op::constraint:
      return constraint(a, d);
    case Op::aim:
      return aim(a, d);
    case Op::ik_two_bone:
      return two_bone(a, d);
    case Op::ik_chain:
      return chain(a, d);
    case Op::limit_vector:
      return limit_vector(a, d);
    case Op::limit_rotation:
      return limit_rotation(a, d);
    case Op::spline:
      return spline(a, d);
    case Op::remap:
      return remap(a, d);
    default:
      break;
  }
  FAIL("a new kernel needs a twin here: " << eval::row(op).name);
  return {};
}

/// How far rows are from a twin's answer: angles in radians, lengths relative to its size.
class Errors {
 public:
  Errors(const Result& want, const Numbers& got) : size_(want.size), got_(got) {
    for (const Part& part : want.parts)
      std::visit([this](const auto& each) { (*this)(each); }, part);
    REQUIRE(at_ == got.size());
  }
  Real largest() const { return largest_; }

  void operator()(Real number) { note(fabsl(got_[at_++] - number) / size_); }
  void operator()(Ratio ratio) {
    const Real size = fabsl(ratio.value);
    note(fabsl(got_[at_++] - ratio.value) / (size > 0 ? size : 1));
  }
  void operator()(V place) { note(length(next() - place) / size_); }
  void operator()(const M& turned) {
    note(angle_between(turn(quat_at(got_, at_)), turned));
    at_ += 4;
  }
  void operator()(const Angles& angles) {
    const V v = next();
    note(angle_between(turn_degrees(2, v.z) * turn_degrees(1, v.y) * turn_degrees(0, v.x),
                       angles.turn));
  }
  void operator()(const A& world) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Real axis = length(world.linear[i]);
      note(length(next() - world.linear[i]) / (axis > 0 ? axis : 1));
    }
    (*this)(world.origin);
  }

 private:
  V next() {
    at_ += 3;
    return vec3_at(got_, at_ - 3);
  }
  // Of NaN too: it is never below a bound.
  void note(Real error) { largest_ = error <= largest_ ? largest_ : error; }

  Real size_, largest_ = 0;
  const Numbers& got_;
  std::size_t at_ = 0;
};

inline Real error_of(const Result& want, const Numbers& got) { return Errors(want, got).largest(); }

}  // namespace rigc::exact
