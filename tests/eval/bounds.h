// SPDX-License-Identifier: MIT
// What each kernel owes: how far it may be from its twin, and for which numbers its result is
// finite. Test: tests/eval/twins_test.cpp, tests/eval/hostile_test.cpp
#pragma once

#include <array>

#include "eval/kernels/table.h"

namespace rigc::test {

enum class Finite {
  in_range,  ///< for numbers of magnitude up to 2^150: products of six of them do not overflow
  always     ///< whatever comes in; overflow becomes the largest number, no number at all 0
};

struct Bound {
  eval::Op op;
  /// In units of 2^-52: radians of rotations; lengths relative to the larger of the limb and its
  /// distance from the origin; numbers relative to themselves, or to what cancels. Times the
  /// condition of the input that the twin states: 1 away from where an answer turns steep.
  double error;
  Finite finite;
};

inline constexpr std::array<Bound, static_cast<std::size_t>(eval::Op::count)> kBounds = {{
    {eval::Op::compose, 6, Finite::in_range},
    {eval::Op::multiply, 2, Finite::in_range},
    {eval::Op::gather, 0, Finite::in_range},
    {eval::Op::from_euler, 1, Finite::in_range},
    {eval::Op::to_euler, 8, Finite::in_range},
    {eval::Op::constraint, 8, Finite::in_range},
    {eval::Op::aim, 8, Finite::in_range},
    {eval::Op::ik_two_bone, 8, Finite::in_range},
    {eval::Op::ik_chain, 2048, Finite::in_range},
    {eval::Op::limit_vector, 16, Finite::in_range},
    {eval::Op::limit_rotation, 16, Finite::in_range},
    {eval::Op::remap, 4, Finite::always},
    {eval::Op::negate, 0, Finite::always},
    {eval::Op::logical_not, 0, Finite::always},
    {eval::Op::add, 0.5, Finite::always},
    {eval::Op::subtract, 0.5, Finite::always},
    {eval::Op::multiply_numbers, 0.5, Finite::always},
    {eval::Op::divide, 0.5, Finite::always},
    {eval::Op::modulo, 0.5, Finite::always},
    {eval::Op::power, 4, Finite::always},
    {eval::Op::less, 0, Finite::always},
    {eval::Op::less_equal, 0, Finite::always},
    {eval::Op::greater, 0, Finite::always},
    {eval::Op::greater_equal, 0, Finite::always},
    {eval::Op::equal, 0, Finite::always},
    {eval::Op::not_equal, 0, Finite::always},
    {eval::Op::logical_and, 0, Finite::always},
    {eval::Op::logical_or, 0, Finite::always},
    {eval::Op::select, 0, Finite::always},
    {eval::Op::sin, 1.5, Finite::always},
    {eval::Op::cos, 1.5, Finite::always},
    {eval::Op::tan, 3, Finite::always},
    {eval::Op::asin, 3, Finite::always},
    {eval::Op::acos, 3, Finite::always},
    {eval::Op::atan, 2, Finite::always},
    {eval::Op::atan2, 3, Finite::always},
    {eval::Op::sqrt, 0.5, Finite::always},
    {eval::Op::abs, 0, Finite::always},
    {eval::Op::sign, 0, Finite::always},
    {eval::Op::floor, 0, Finite::always},
    {eval::Op::ceil, 0, Finite::always},
    {eval::Op::round, 0, Finite::always},
    {eval::Op::exp, 1, Finite::always},
    {eval::Op::log, 1, Finite::always},
    {eval::Op::min, 0, Finite::always},
    {eval::Op::max, 0, Finite::always},
    {eval::Op::clamp, 0, Finite::always},
    {eval::Op::lerp, 1, Finite::always},
    {eval::Op::smoothstep, 4, Finite::always},
    {eval::Op::hypot, 1, Finite::always},
}};

constexpr bool bounds_complete() {
  for (std::size_t i = 0; i < kBounds.size(); ++i)
    if (static_cast<std::size_t>(kBounds[i].op) != i) return false;
  return true;
}
static_assert(bounds_complete());

inline const Bound& bound(eval::Op op) { return kBounds[static_cast<std::size_t>(op)]; }

}  // namespace rigc::test
