// SPDX-License-Identifier: MIT
// The one table of kernels: operation, name, function, number of arguments.
// Test: tests/eval/numbers_test.cpp
#pragma once

#include <cstdint>
#include <string_view>

#include "eval/isa.h"
#include "eval/kernels/call.h"

namespace rigc::eval {

enum class Op : std::uint8_t {
  // Transforms.
  compose,        ///< translation, rotation, scale -> T * R * S
  compose_rigid,  ///< translation, rotation -> T * R
  compose_under,  ///< translation, rotation; data: t, unit q -> translation(t) * rotation(q) * T *
                  ///< R
  multiply,       ///< a, b -> a * b
  hang,           ///< parent, turned; data: 9 numbers L, t -> linear turned * L, origin parent * t
  hang_straight,  ///< parent, turned; data: t -> linear of turned, origin parent * t
  place,          ///< parent, turned, t -> linear of turned, origin parent * t
  gather,         ///< any registers, one after the other
  from_euler,     ///< degrees -> rotation
  to_euler,       ///< rotation -> degrees
  // Solvers; scene/kinds.h says what they mean.
  constraint,  ///< parent, (target, weight)...; data: constraint_table.h -> translate, rotation,
               ///< scale
  aim,  ///< parent, position, up_target, up_vector, (target, weight)...; data: count, mode, offset
        ///< -> rotation
  blend,      ///< (target, weight)...; data: count, of each target 9 numbers L that make target * L
              ///< a rotation, t -> the mean of the rotations and of target * t, as a matrix
  aim_world,  ///< as aim; data: count, mode, 9 numbers L -> linear: the aim frame times L, origin:
              ///< parent * position
  ik_two_bone,  ///< base ... middle_scale; data: goal offset, rotation offsets, normal -> two
                ///< worlds
  ik_chain,     ///< base, goal, pole, twist, translates...; data: count, has_pole, iterations, goal
                ///< offset, rests -> rotations
  limit_vector,    ///< vector; data: LimitSpace -> vector
  limit_rotation,  ///< rotation; data: LimitSpace -> rotation
  spline,  ///< base, preserve, controls..., twists...; data: spline_table.h -> length, stretch,
           ///< worlds
  remap,   ///< input, its range, output's range; data: clamp, count, points -> number
  // Formulas over vectors, rotations and matrices; kernels/vectors.h says what they mean.
  vector_add,         ///< a, b -> a + b
  vector_subtract,    ///< a, b -> a - b
  vector_scale,       ///< vector, number
  vector_multiply,    ///< component by component
  vector_lerp,        ///< a, b, t -> a + (b - a) t
  dot,                ///< vector, vector -> number
  cross,              ///< vector, vector -> vector
  length,             ///< vector -> number
  normalise,          ///< vector -> at unit length, or zero
  rotation_multiply,  ///< a, b -> by b, then by a
  rotation_inverse,   ///< rotation
  rotation_apply,     ///< rotation, vector -> vector
  rotation_slerp,     ///< a, b, t -> part of the nearer way
  axis_angle,         ///< axis, degrees -> rotation
  twist_angle,        ///< rotation, axis -> degrees about the axis
  between,            ///< direction, direction -> the shortest rotation
  aim_rotation,       ///< primary, secondary -> rotation of x and y there
  matrix_rotation,    ///< matrix -> rotation
  matrix_scale,       ///< matrix -> scale along its axes
  matrix_inverse,     ///< matrix
  transform_point,    ///< matrix, point -> point
  transform_vector,   ///< matrix, vector -> vector
  choose,             ///< condition, where true, where false; of any width
  // Formulas of numbers, in the order of scene::FormulaOp from negate on.
  negate,
  logical_not,
  add,
  subtract,
  multiply_numbers,
  divide,
  modulo,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  select,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  atan2,
  sqrt,
  abs,
  sign,
  floor,
  ceil,
  round,
  exp,
  log,
  min,
  max,
  clamp,
  lerp,
  smoothstep,
  hypot,
  count
};

struct KernelRow {
  Op op;
  std::string_view name;
  Kernel kernel;
  int arguments;  ///< -1: as many as the instruction says
};

/// The table of an instruction set, by operation.
const KernelRow* kernels(Isa isa);
const KernelRow& row(Op op, Isa isa = default_isa());

/// The most joints that an ik_chain has; checked when a program is compiled.
inline constexpr int kMaxChainJoints = 256;

}  // namespace rigc::eval
