// SPDX-License-Identifier: MIT
// Formulas of expression and compute nodes: text in, a list of operations out, each over the
// results of earlier ones. Modules parse to check, eval to compile. Every operation on numbers
// gives a finite number: what has no value (1 / 0, log of -1) is 0. Test:
// tests/scene/formula_test.cpp
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "scene/value.h"

namespace rigc::scene {

/// An operation of a formula. Truth is 1 and 0; whatever is not 0 is true. Angles are in degrees.
enum class FormulaOp : std::uint8_t {
  constant,  ///< pushes `value`
  input,     ///< pushes input number `input`
  negate,
  logical_not,
  add,
  subtract,
  multiply,
  divide,  ///< by 0: 0
  modulo,  ///< a - b floor(a / b), with the sign of b; by 0: 0
  power,   ///< of a negative number only to whole powers, else 0
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  select,  ///< condition, where true, where false
  sin,
  cos,
  tan,
  asin,
  acos,  ///< the argument is clamped to -1..1
  atan,
  atan2,
  sqrt,  ///< of a negative number: 0
  abs,
  sign,
  floor,
  ceil,
  round,  ///< halves away from zero
  exp,
  log,  ///< of 0 and below: 0
  min,
  max,
  clamp,       ///< value, low, high; high wins where low is above it
  lerp,        ///< a, b, t: a + (b - a) t
  smoothstep,  ///< low, high, value; a step where low = high
  hypot,
  // Vectors, rotations and matrices. Vectors and rotations may be of any length.
  vector_add,
  vector_subtract,
  vector_scale,     ///< vector, number
  vector_multiply,  ///< component by component
  vector_lerp,      ///< a, b, t: a + (b - a) t
  dot,
  cross,
  length,
  normalise,          ///< zero where it is shorter than 1e-30
  rotation_multiply,  ///< by the second, then by the first
  rotation_inverse,
  rotation_apply,  ///< rotation, vector
  rotation_slerp,  ///< a, b, t in 0..1: part of the nearer way
  axis_angle,      ///< axis, degrees
  twist_angle,     ///< rotation, axis: degrees about it once the swing is taken off, -180..180
  between,         ///< the shortest rotation from one direction to another
  aim_rotation,    ///< x along the first direction, y leaning to the second
  matrix_rotation,
  matrix_scale,      ///< along its own axes; z is negative where it is mirrored
  matrix_inverse,    ///< of a flat matrix the inverse of its rotation
  transform_point,   ///< matrix, point
  transform_vector,  ///< matrix, vector: without the origin
  choose,            ///< condition, where true, where false: of any type
  matrix_multiply,
  compose,        ///< point, rotation, scale
  compose_rigid,  ///< point, rotation
  from_euler,     ///< degrees about X, then Y, then Z
  to_euler,
  gather,     ///< three numbers: a vector
  component,  ///< `input` is the first number of it
  count
};

/// Values that an operation takes from the stack: 0 to 3.
int arity(FormulaOp op);
std::string_view name_of(FormulaOp op);

/// A function that formulas may call.
struct FormulaFunction {
  std::string_view name;
  FormulaOp op;
  int least, most;  ///< arguments; min and max fold any number
  std::string_view help;
};
std::span<const FormulaFunction> formula_functions();

/// A function of formulas over other types than numbers; several may have one name.
struct TypedFunction {
  std::string_view name;
  FormulaOp op;
  Type result;
  std::array<Type, 3> arguments;
  std::size_t count;  ///< of them
  std::string_view help;
};
std::span<const TypedFunction> typed_functions();

/// Operations in the order in which they are computed; of an expression that is postfix order.
struct Formula {
  struct Step {
    FormulaOp op = FormulaOp::constant;
    double value = 0;  ///< of a constant
    int input = 0;     ///< of an input its element; of a component the first number
    Type type = Type::number;
    std::array<int, 3> arguments{-1, -1, -1};  ///< earlier steps
  };
  /// What a program takes or gives. `element`: which of those of its type.
  struct Named {
    std::string name;
    Type type = Type::number;
    int element = 0;
    int step = 0;
  };
  std::vector<Step> steps;
  int result = 0;  ///< step of an expression's value
  std::vector<Named> inputs, outputs;
};

/// Parses an expression of numbers over `inputs` inputs, `$0` and up. Errors are reported at
/// `span`, which is where the text came from, with the column inside the text in the message.
std::optional<Formula> parse_formula(std::string_view text, const Span& span, int inputs,
                                     Diagnostics& diagnostics);

/// Parses a program, statements that end in `;`:
///   in goal: matrix, stretch: number;       what it takes: number, vector, rotation, matrix
///   reach = length(goal.origin);            a value that later statements use
///   out factor = max(1, reach / 2);         what it gives
/// Operators: numbers as in expressions; vector + - vector, vector * number, vector / number,
/// rotation * rotation, rotation * vector, matrix * matrix, matrix * point; members x y z of
/// vectors, x y z origin of matrices.
std::optional<Formula> parse_program(std::string_view text, const Span& span,
                                     Diagnostics& diagnostics);

/// Which steps the value of `step` needs, itself included: one flag a step.
std::vector<bool> needed_steps(const Formula& formula, int step);

}  // namespace rigc::scene
