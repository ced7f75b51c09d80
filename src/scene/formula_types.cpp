// SPDX-License-Identifier: MIT
// The tables of types of formulas. Test: tests/scene/formula_test.cpp
#include "scene/formula_types.h"

#include <algorithm>
#include <array>

namespace rigc::scene {

namespace {

using enum FormulaOp;
constexpr Type kNumber = Type::number, kVector = Type::vec3, kTurn = Type::quat,
               kMatrix = Type::matrix;

constexpr Overload kOverloads[] = {
    {add, kVector, kVector, vector_add, kVector},
    {subtract, kVector, kVector, vector_subtract, kVector},
    {multiply, kVector, kNumber, vector_scale, kVector},
    {multiply, kTurn, kTurn, rotation_multiply, kTurn},
    {multiply, kTurn, kVector, rotation_apply, kVector},
    {multiply, kMatrix, kMatrix, matrix_multiply, kMatrix},
    {multiply, kMatrix, kVector, transform_point, kVector},
};

constexpr Member kMembers[] = {{kVector, "x", 0, kNumber},     {kVector, "y", 1, kNumber},
                               {kVector, "z", 2, kNumber},     {kMatrix, "x", 0, kVector},
                               {kMatrix, "y", 3, kVector},     {kMatrix, "z", 6, kVector},
                               {kMatrix, "origin", 9, kVector}};

constexpr std::string_view kTypes[] = {"number", "vector", "rotation", "matrix"};

constexpr TypedFunction kFunctions[] = {
    {"aim",
     aim_rotation,
     kTurn,
     {kVector, kVector},
     2,
     "x along the first direction, y to the second"},
    {"angles", to_euler, kVector, {kTurn}, 1, "degrees about X, then Y, then Z"},
    {"axis_angle", axis_angle, kTurn, {kVector, kNumber}, 2, "a turn about an axis by degrees"},
    {"between", between, kTurn, {kVector, kVector}, 2, "the shortest turn between two directions"},
    {"compose", compose, kMatrix, {kVector, kTurn, kVector}, 3, "point, rotation, scale"},
    {"cross", cross, kVector, {kVector, kVector}, 2, "vector at right angles to both"},
    {"direction", transform_vector, kVector, {kMatrix, kVector}, 2, "a vector of a matrix's space"},
    {"dot", dot, kNumber, {kVector, kVector}, 2, "scalar product"},
    {"euler", from_euler, kTurn, {kVector}, 1, "a turn by degrees about X, then Y, then Z"},
    {"frame", compose_rigid, kMatrix, {kVector, kTurn}, 2, "point, rotation"},
    {"inverse", rotation_inverse, kTurn, {kTurn}, 1, "the turn back"},
    {"inverse", matrix_inverse, kMatrix, {kMatrix}, 1, "into a matrix's space"},
    {"length", length, kNumber, {kVector}, 1, "how long a vector is"},
    {"lerp", vector_lerp, kVector, {kVector, kVector, kNumber}, 3, "from a at t = 0 to b at t = 1"},
    {"multiply", vector_multiply, kVector, {kVector, kVector}, 2, "component by component"},
    {"normalise", normalise, kVector, {kVector}, 1, "at unit length, or zero"},
    {"rotation", matrix_rotation, kTurn, {kMatrix}, 1, "of a matrix without its scale"},
    {"scale", matrix_scale, kVector, {kMatrix}, 1, "of a matrix along its own axes"},
    {"slerp", rotation_slerp, kTurn, {kTurn, kTurn, kNumber}, 3, "part of the nearer way"},
    {"twist", twist_angle, kNumber, {kTurn, kVector}, 2, "degrees that it turns about an axis"},
    {"vector", gather, kVector, {kNumber, kNumber, kNumber}, 3, "x, y, z"},
};

}  // namespace

const Overload* overload(FormulaOp op, Type left, Type right) {
  const auto found = std::find_if(std::begin(kOverloads), std::end(kOverloads), [&](const auto& o) {
    return o.op == op && o.left == left && o.right == right;
  });
  return found == std::end(kOverloads) ? nullptr : found;
}

const Member* member(Type of, std::string_view name) {
  const auto found = std::find_if(std::begin(kMembers), std::end(kMembers),
                                  [&](const auto& m) { return m.of == of && m.name == name; });
  return found == std::end(kMembers) ? nullptr : found;
}

std::string_view formula_type(Type type) { return kTypes[static_cast<std::size_t>(type)]; }

std::optional<Type> parse_formula_type(std::string_view name) {
  const auto found = std::find(std::begin(kTypes), std::end(kTypes), name);
  if (found == std::end(kTypes)) return std::nullopt;
  return static_cast<Type>(found - std::begin(kTypes));
}

std::span<const TypedFunction> typed_functions() { return kFunctions; }

}  // namespace rigc::scene
