// SPDX-License-Identifier: MIT
// What operators, members and functions of formulas mean for values of each type.
// Test: tests/scene/formula_test.cpp
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "scene/formula.h"

namespace rigc::scene {

/// What an operator of two numbers does with other types.
struct Overload {
  FormulaOp op;
  Type left, right;
  FormulaOp means;
  Type result;
};
/// Null where it has no meaning.
const Overload* overload(FormulaOp op, Type left, Type right);

/// Part of a value by its name: vectors have x, y, z; matrices have x, y, z and origin.
struct Member {
  Type of;
  std::string_view name;
  int first;  ///< number of the value at which it begins
  Type type;
};
/// Null where it has none of this name.
const Member* member(Type of, std::string_view name);

/// number, vector, rotation or matrix.
std::string_view formula_type(Type type);
std::optional<Type> parse_formula_type(std::string_view name);

}  // namespace rigc::scene
