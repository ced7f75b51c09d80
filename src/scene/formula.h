// SPDX-License-Identifier: MIT
// Formulas of expression nodes: text in, a postfix list of operations out. Modules parse to check,
// eval to compile. Every operation gives a finite number: what has no value (1 / 0, log of -1) is
// 0. Test: tests/scene/formula_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

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

/// Operations in postfix order: each takes its arguments off a stack and pushes its result.
struct Formula {
  struct Step {
    FormulaOp op = FormulaOp::constant;
    double value = 0;  ///< of a constant
    int input = 0;     ///< of an input
  };
  std::vector<Step> steps;
};

/// Parses a formula over `inputs` inputs, `$0` and up. Errors are reported at `span`, which is
/// where the text came from, with the column inside the text in the message.
std::optional<Formula> parse_formula(std::string_view text, const Span& span, int inputs,
                                     Diagnostics& diagnostics);

}  // namespace rigc::scene
