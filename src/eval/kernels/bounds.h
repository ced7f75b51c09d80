// SPDX-License-Identifier: MIT
// What each kernel owes: how far it may be from its twin, and for which numbers its result is
// finite. Test: tests/eval/twins_test.cpp, tests/eval/hostile_test.cpp
#pragma once

#include <array>

#include "eval/kernels/table.h"

namespace rigc::eval {

enum class Finite {
  in_range,  ///< for numbers of magnitude up to 2^150: products of six of them do not overflow
  always     ///< whatever comes in; overflow becomes the largest number, no number at all 0
};

struct Bound {
  Op op;
  /// In units of 2^-52: radians of rotations; lengths relative to the larger of the limb and its
  /// distance from the origin; numbers relative to themselves, or to what cancels. Times the
  /// condition of the input that the twin states: 1 away from where an answer turns steep.
  double error;
  Finite finite;
};

inline constexpr std::array<Bound, static_cast<std::size_t>(Op::count)> kBounds = {{
    {Op::compose, 6, Finite::in_range},
    {Op::compose_rigid, 6, Finite::in_range},
    {Op::compose_under, 6, Finite::in_range},
    {Op::multiply, 2, Finite::in_range},
    {Op::hang, 2, Finite::in_range},
    {Op::hang_straight, 2, Finite::in_range},
    {Op::place, 2, Finite::in_range},
    {Op::gather, 0, Finite::in_range},
    {Op::from_euler, 1, Finite::in_range},
    {Op::to_euler, 8, Finite::in_range},
    {Op::constraint, 8, Finite::in_range},
    {Op::aim, 8, Finite::in_range},
    {Op::blend, 8, Finite::in_range},
    {Op::aim_world, 8, Finite::in_range},
    {Op::ik_two_bone, 8, Finite::in_range},
    {Op::ik_chain, 2048, Finite::in_range},
    {Op::limit_vector, 16, Finite::in_range},
    {Op::limit_rotation, 16, Finite::in_range},
    {Op::spline, 256, Finite::in_range},
    {Op::remap, 4, Finite::always},
    {Op::vector_add, 0.5, Finite::in_range},
    {Op::vector_subtract, 0.5, Finite::in_range},
    {Op::vector_scale, 0.5, Finite::in_range},
    {Op::vector_multiply, 0.5, Finite::in_range},
    {Op::vector_lerp, 1.5, Finite::in_range},
    {Op::dot, 1.5, Finite::in_range},
    {Op::cross, 1.5, Finite::in_range},
    {Op::length, 2.5, Finite::in_range},
    {Op::normalise, 3, Finite::in_range},
    {Op::rotation_multiply, 10, Finite::in_range},
    {Op::rotation_inverse, 1, Finite::in_range},
    {Op::rotation_apply, 8, Finite::in_range},
    {Op::rotation_slerp, 8, Finite::in_range},
    {Op::axis_angle, 4, Finite::in_range},
    {Op::twist_angle, 16, Finite::in_range},
    {Op::between, 8, Finite::in_range},
    {Op::aim_rotation, 8, Finite::in_range},
    {Op::matrix_rotation, 8, Finite::in_range},
    {Op::matrix_scale, 8, Finite::in_range},
    {Op::matrix_inverse, 8, Finite::in_range},
    {Op::transform_point, 2, Finite::in_range},
    {Op::transform_vector, 2, Finite::in_range},
    {Op::choose, 0, Finite::in_range},
    {Op::negate, 0, Finite::always},
    {Op::logical_not, 0, Finite::always},
    {Op::add, 0.5, Finite::always},
    {Op::subtract, 0.5, Finite::always},
    {Op::multiply_numbers, 0.5, Finite::always},
    {Op::divide, 0.5, Finite::always},
    {Op::modulo, 0.5, Finite::always},
    {Op::power, 4, Finite::always},
    {Op::less, 0, Finite::always},
    {Op::less_equal, 0, Finite::always},
    {Op::greater, 0, Finite::always},
    {Op::greater_equal, 0, Finite::always},
    {Op::equal, 0, Finite::always},
    {Op::not_equal, 0, Finite::always},
    {Op::logical_and, 0, Finite::always},
    {Op::logical_or, 0, Finite::always},
    {Op::select, 0, Finite::always},
    {Op::sin, 1.5, Finite::always},
    {Op::cos, 1.5, Finite::always},
    {Op::tan, 3, Finite::always},
    {Op::asin, 3, Finite::always},
    {Op::acos, 3, Finite::always},
    {Op::atan, 2, Finite::always},
    {Op::atan2, 3, Finite::always},
    {Op::sqrt, 0.5, Finite::always},
    {Op::abs, 0, Finite::always},
    {Op::sign, 0, Finite::always},
    {Op::floor, 0, Finite::always},
    {Op::ceil, 0, Finite::always},
    {Op::round, 0, Finite::always},
    {Op::exp, 1, Finite::always},
    {Op::log, 1, Finite::always},
    {Op::min, 0, Finite::always},
    {Op::max, 0, Finite::always},
    {Op::clamp, 0, Finite::always},
    {Op::lerp, 1, Finite::always},
    {Op::smoothstep, 4, Finite::always},
    {Op::hypot, 1, Finite::always},
}};

constexpr bool bounds_complete() {
  for (std::size_t i = 0; i < kBounds.size(); ++i)
    if (static_cast<std::size_t>(kBounds[i].op) != i) return false;
  return true;
}
static_assert(bounds_complete());

inline const Bound& bound(Op op) { return kBounds[static_cast<std::size_t>(op)]; }

}  // namespace rigc::eval
