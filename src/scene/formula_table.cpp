// SPDX-License-Identifier: MIT
// The operations of formulas and the functions that people call them by.
// Test: tests/scene/formula_test.cpp
#include <array>

#include "scene/formula.h"

namespace rigc::scene {

namespace {

struct OpRow {
  FormulaOp op;
  std::string_view name;
  int arity;
};

using enum FormulaOp;

constexpr std::array<OpRow, static_cast<std::size_t>(count)> kOps = {{
    {constant, "constant", 0},
    {input, "input", 0},
    {negate, "negate", 1},
    {logical_not, "not", 1},
    {add, "add", 2},
    {subtract, "subtract", 2},
    {multiply, "multiply", 2},
    {divide, "divide", 2},
    {modulo, "modulo", 2},
    {power, "power", 2},
    {less, "less", 2},
    {less_equal, "less_equal", 2},
    {greater, "greater", 2},
    {greater_equal, "greater_equal", 2},
    {equal, "equal", 2},
    {not_equal, "not_equal", 2},
    {logical_and, "and", 2},
    {logical_or, "or", 2},
    {select, "select", 3},
    {sin, "sin", 1},
    {cos, "cos", 1},
    {tan, "tan", 1},
    {asin, "asin", 1},
    {acos, "acos", 1},
    {atan, "atan", 1},
    {atan2, "atan2", 2},
    {sqrt, "sqrt", 1},
    {abs, "abs", 1},
    {sign, "sign", 1},
    {floor, "floor", 1},
    {ceil, "ceil", 1},
    {round, "round", 1},
    {exp, "exp", 1},
    {log, "log", 1},
    {min, "min", 2},
    {max, "max", 2},
    {clamp, "clamp", 3},
    {lerp, "lerp", 3},
    {smoothstep, "smoothstep", 3},
    {hypot, "hypot", 2},
    {vector_add, "vector_add", 2},
    {vector_subtract, "vector_subtract", 2},
    {vector_scale, "vector_scale", 2},
    {vector_multiply, "vector_multiply", 2},
    {vector_lerp, "vector_lerp", 3},
    {dot, "dot", 2},
    {cross, "cross", 2},
    {length, "length", 1},
    {normalise, "normalise", 1},
    {rotation_multiply, "rotation_multiply", 2},
    {rotation_inverse, "rotation_inverse", 1},
    {rotation_apply, "rotation_apply", 2},
    {rotation_slerp, "rotation_slerp", 3},
    {axis_angle, "axis_angle", 2},
    {twist_angle, "twist_angle", 2},
    {between, "between", 2},
    {aim_rotation, "aim_rotation", 2},
    {matrix_rotation, "matrix_rotation", 1},
    {matrix_scale, "matrix_scale", 1},
    {matrix_inverse, "matrix_inverse", 1},
    {transform_point, "transform_point", 2},
    {transform_vector, "transform_vector", 2},
    {choose, "choose", 3},
    {matrix_multiply, "matrix_multiply", 2},
    {compose, "compose", 3},
    {compose_rigid, "compose_rigid", 2},
    {from_euler, "from_euler", 1},
    {to_euler, "to_euler", 1},
    {gather, "gather", 3},
    {component, "component", 1},
}};

constexpr bool complete() {
  for (std::size_t i = 0; i < kOps.size(); ++i) {
    if (static_cast<std::size_t>(kOps[i].op) != i || kOps[i].name.empty()) return false;
  }
  return true;
}
static_assert(complete());

constexpr int kAny = 1000;  // min and max take as many as they are given

constexpr FormulaFunction kFunctions[] = {
    {"abs", abs, 1, 1, "without its sign"},
    {"acos", acos, 1, 1, "angle in degrees whose cosine it is"},
    {"asin", asin, 1, 1, "angle in degrees whose sine it is"},
    {"atan", atan, 1, 1, "angle in degrees whose tangent it is"},
    {"atan2", atan2, 2, 2, "angle in degrees of the point y, x"},
    {"ceil", ceil, 1, 1, "next whole number up"},
    {"clamp", clamp, 3, 3, "value, low, high: the value held in a range"},
    {"cos", cos, 1, 1, "cosine of degrees"},
    {"exp", exp, 1, 1, "e to the power"},
    {"floor", floor, 1, 1, "next whole number down"},
    {"hypot", hypot, 2, 2, "length of the vector x, y"},
    {"if", select, 3, 3, "condition, where true, where false"},
    {"lerp", lerp, 3, 3, "a, b, t: from a at t = 0 to b at t = 1"},
    {"log", log, 1, 1, "natural logarithm"},
    {"max", max, 2, kAny, "the largest"},
    {"min", min, 2, kAny, "the smallest"},
    {"mod", modulo, 2, 2, "remainder, with the sign of the divisor"},
    {"pow", power, 2, 2, "base to the power"},
    {"round", round, 1, 1, "nearest whole number, halves away from zero"},
    {"sign", sign, 1, 1, "-1, 0 or 1"},
    {"sin", sin, 1, 1, "sine of degrees"},
    {"smoothstep", smoothstep, 3, 3, "low, high, value: 0 to 1 with smooth ends"},
    {"sqrt", sqrt, 1, 1, "square root"},
    {"tan", tan, 1, 1, "tangent of degrees"},
};

}  // namespace

int arity(FormulaOp op) { return kOps[static_cast<std::size_t>(op)].arity; }

std::string_view name_of(FormulaOp op) { return kOps[static_cast<std::size_t>(op)].name; }

std::span<const FormulaFunction> formula_functions() { return kFunctions; }

std::vector<bool> needed_steps(const Formula& formula, int step) {
  std::vector<bool> needed(formula.steps.size());
  needed[static_cast<std::size_t>(step)] = true;
  for (std::size_t i = needed.size(); i-- > 0;) {
    if (!needed[i]) continue;
    for (const int argument : formula.steps[i].arguments) {
      if (argument >= 0) needed[static_cast<std::size_t>(argument)] = true;
    }
  }
  return needed;
}

}  // namespace rigc::scene
