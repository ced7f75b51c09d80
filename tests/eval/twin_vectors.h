// SPDX-License-Identifier: MIT
// The scalar twins of formulas over vectors, rotations and matrices, in long double; what each
// means is in scene/formula.h. Test: tests/eval/twins_test.cpp
#pragma once

#include "tests/eval/twin_solvers.h"

namespace rigc::exact {

/// Measured against `size`: the answer's own, or that of what cancels in it.
inline Result answer(const Part& part, Real size) {
  Result out;
  out.parts = {part};
  out.size = fmaxl(size, 1e-300L);
  return out;
}
inline Result answer(V v) { return answer(v, length(v)); }
inline Result answer(const M& turned, Real condition) {
  Result out = answer(Part(turned), 1);
  out.condition = fmaxl(1, condition);
  return out;
}

inline M turn_at(const Arguments& a, std::size_t i) { return turn(std::get<math::Quat>(a[i])); }

inline Real longest_column(const M& m) {
  return fmaxl(length(m.x), fmaxl(length(m.y), length(m.z)));
}

inline Result vector_lerp(V a, V b, Real t) {
  return answer(a + (b - a) * t, length(a) + length((b - a) * t));
}

/// The quaternion, scalar last, at unit length; none where it has no length.
struct Four {
  V xyz;
  Real w = 1;
};
inline Four four(const math::Quat& q) {
  const V xyz{q.x, q.y, q.z};
  const Real size = hypotl(length(xyz), q.w);
  return size < 1e-30L ? Four{} : Four{xyz * (1 / size), q.w / size};
}
/// a times the inverse of b.
inline Four ratio(Four a, Four b) {
  return {b.xyz * -a.w + a.xyz * b.w - cross(a.xyz, b.xyz), a.w * b.w + dot(a.xyz, b.xyz)};
}

/// Half a turn apart both ways are as near.
inline Result rotation_slerp(const math::Quat& a, const math::Quat& b, Real t) {
  Four way = ratio(four(b), four(a));
  if (way.w < 0) way = {-way.xyz, -way.w};
  const Real angle = 2 * atan2l(length(way.xyz), way.w);
  const V axis = length(way.xyz) > 0 ? way.xyz * (1 / length(way.xyz)) : V{1, 0, 0};
  Result out = answer(turn(axis, angle * std::clamp(t, 0.0L, 1.0L)) * turn(a), 1);
  out.certain = way.w > 1e-12L;
  return out;
}

inline Result rotation_about(V axis, Real degrees) {
  const V along = unit(axis);
  return answer(length(along) == 0 ? M{} : turn(along, degrees * kDegree), 1);
}

/// The angle of what is left once the shortest turn of the axis is taken off. Steep near a half
/// turn across the axis, where any angle is as good; 180 and -180 are the same. Within radians.
inline Result twist_angle(const math::Quat& q, V any_axis) {
  const V axis = unit(any_axis);
  if (length(axis) == 0) return answer(0.0L, 1 / kDegree);
  const V turned = turn(q) * axis;
  const M twist = transposed(shortest(axis, turned)) * turn(q);
  const V twice{twist.y.z - twist.z.y, twist.z.x - twist.x.z, twist.x.y - twist.y.x};
  const Real angle = atan2l(dot(twice, axis), twist.x.x + twist.y.y + twist.z.z - 1);
  Result out = answer(angle / kDegree, 1 / kDegree);
  const Real off = length(axis + turned) / 2;  // cosine of half the swing
  out.condition = 1 / fmaxl(off, 1e-12L);
  out.certain = off > 1e-5L && fabsl(angle) < kPi - 1e-6L * out.condition;
  return out;
}

/// Steep near opposite directions, where the axis may be any.
inline Result between(V from, V to) {
  const V a = unit(from), b = unit(to);
  if (length(a) == 0 || length(b) == 0) return answer(M{}, 1);
  const Real sine = length(cross(a, b));
  if (dot(a, b) > 0) return answer(shortest(a, b), 1);
  Result out = answer(shortest(a, b), 1 / fmaxl(sine, 1e-12L));
  out.certain = sine > 1e-5L;
  return out;
}

/// Steep where the secondary direction comes near the primary.
inline Result aim_rotation(V primary, V secondary) {
  const V x = unit(primary, {1, 0, 0});
  const Real sine = length(beside(unit(secondary), x));
  Result out = answer(frame(x, unit(secondary)), 1 / fmaxl(sine, 1e-12L));
  out.certain = sine > 1e-5L;
  return out;
}

inline Result of_matrix(const M& m, Result out) {
  out.condition = condition_of(m);
  out.certain = out.condition < 1e6L;
  return out;
}

inline Result matrix_inverse(const A& a) {
  const A back = into(a);
  Result out = answer(back, longest_column(back.linear) * length(a.origin));
  return of_matrix(a.linear, out);
}

inline Result choose(const Arguments& a) {
  const scene::Value& chosen = a[number_at(a, 0) != 0 ? 1 : 2];
  if (const auto* n = std::get_if<double>(&chosen)) return answer(static_cast<Real>(*n), 1);
  if (const auto* v = std::get_if<math::Vec3>(&chosen)) return answer(V(*v));
  if (const auto* q = std::get_if<math::Quat>(&chosen)) return answer(turn(*q), 1);
  return answer(A(std::get<math::Affine>(chosen)), 1);
}

/// Of the operations from vector_add to choose.
inline Result vector_formula(eval::Op op, const Arguments& a) {
  using eval::Op;
  const auto v = [&](std::size_t i) { return vector_at(a, i); };
  const auto m = [&](std::size_t i) { return A(matrix_at(a, i)); };
  const auto q = [&](std::size_t i) { return std::get<math::Quat>(a[i]); };
  switch (op) {
    case Op::vector_add:
      return answer(v(0) + v(1));
    case Op::vector_subtract:
      return answer(v(0) - v(1));
    case Op::vector_scale:
      return answer(v(0) * number_at(a, 1));
    case Op::vector_multiply:
      return answer(times_each(v(0), v(1)));
    case Op::vector_lerp:
      return vector_lerp(v(0), v(1), number_at(a, 2));
    case Op::dot:
      return answer(dot(v(0), v(1)), length(v(0)) * length(v(1)));
    case Op::cross:
      return answer(cross(v(0), v(1)), length(v(0)) * length(v(1)));
    case Op::length:
      return answer(length(v(0)), length(v(0)));
    case Op::normalise:
      return answer(unit(v(0)), 1);
    case Op::rotation_multiply:
      return answer(turn_at(a, 0) * turn_at(a, 1), 1);
    case Op::rotation_inverse:
      return answer(transposed(turn_at(a, 0)), 1);
    case Op::rotation_apply:
      return answer(turn_at(a, 0) * v(1));
    case Op::rotation_slerp:
      return rotation_slerp(q(0), q(1), number_at(a, 2));
    case Op::axis_angle:
      return rotation_about(v(0), number_at(a, 1));
    case Op::twist_angle:
      return twist_angle(q(0), v(1));
    case Op::between:
      return between(v(0), v(1));
    case Op::aim_rotation:
      return aim_rotation(v(0), v(1));
    case Op::matrix_rotation:
      return of_matrix(m(0).linear, answer(orthonormal(m(0).linear), 1));
    case Op::matrix_scale:
      return of_matrix(m(0).linear, answer(scales(orthonormal(m(0).linear), m(0).linear),
                                           longest_column(m(0).linear)));
    case Op::matrix_inverse:
      return matrix_inverse(m(0));
    case Op::transform_point:
      return answer(m(0) * v(1), longest_column(m(0).linear) * length(v(1)) + length(m(0).origin));
    case Op::transform_vector:
      return answer(m(0).linear * v(1), longest_column(m(0).linear) * length(v(1)));
    default:
      return choose(a);
  }
}

}  // namespace rigc::exact
