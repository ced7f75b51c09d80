// SPDX-License-Identifier: MIT
// The rows of the table of kernels, complete when compiled. Test: tests/eval/numbers_test.cpp
#include "eval/kernels/table.h"

#include <array>

#include "eval/kernels/numbers.h"

namespace rigc::eval {

namespace {

constexpr int kAny = -1;

constexpr std::array<KernelRow, static_cast<std::size_t>(Op::count)> kKernels = {{
    {Op::compose, "compose", compose, 3},
    {Op::compose_rigid, "compose_rigid", compose_rigid, 2},
    {Op::compose_under, "compose_under", compose_under, 2},
    {Op::multiply, "multiply", multiply, 2},
    {Op::hang, "hang", hang, 2},
    {Op::hang_straight, "hang_straight", hang_straight, 2},
    {Op::place, "place", place, 3},
    {Op::gather, "gather", gather, kAny},
    {Op::from_euler, "from_euler", from_euler, 1},
    {Op::to_euler, "to_euler", to_euler, 1},
    {Op::constraint, "constraint", constraint, kAny},
    {Op::aim, "aim", aim, kAny},
    {Op::blend, "blend", blend, kAny},
    {Op::aim_world, "aim_world", aim_world, kAny},
    {Op::ik_two_bone, "ik_two_bone", ik_two_bone, 9},
    {Op::ik_chain, "ik_chain", ik_chain, kAny},
    {Op::limit_vector, "limit_vector", limit_vector, 1},
    {Op::limit_rotation, "limit_rotation", limit_rotation, 1},
    {Op::remap, "remap", remap, 5},
    {Op::negate, "negate", numbers::negate, 1},
    {Op::logical_not, "not", numbers::logical_not, 1},
    {Op::add, "add", numbers::add, 2},
    {Op::subtract, "subtract", numbers::subtract, 2},
    {Op::multiply_numbers, "multiply_numbers", numbers::multiply, 2},
    {Op::divide, "divide", numbers::divide, 2},
    {Op::modulo, "modulo", numbers::modulo, 2},
    {Op::power, "power", numbers::power, 2},
    {Op::less, "less", numbers::less, 2},
    {Op::less_equal, "less_equal", numbers::less_equal, 2},
    {Op::greater, "greater", numbers::greater, 2},
    {Op::greater_equal, "greater_equal", numbers::greater_equal, 2},
    {Op::equal, "equal", numbers::equal, 2},
    {Op::not_equal, "not_equal", numbers::not_equal, 2},
    {Op::logical_and, "and", numbers::logical_and, 2},
    {Op::logical_or, "or", numbers::logical_or, 2},
    {Op::select, "select", numbers::select, 3},
    {Op::sin, "sin", numbers::sin, 1},
    {Op::cos, "cos", numbers::cos, 1},
    {Op::tan, "tan", numbers::tan, 1},
    {Op::asin, "asin", numbers::asin, 1},
    {Op::acos, "acos", numbers::acos, 1},
    {Op::atan, "atan", numbers::atan, 1},
    {Op::atan2, "atan2", numbers::atan2, 2},
    {Op::sqrt, "sqrt", numbers::sqrt, 1},
    {Op::abs, "abs", numbers::abs, 1},
    {Op::sign, "sign", numbers::sign, 1},
    {Op::floor, "floor", numbers::floor, 1},
    {Op::ceil, "ceil", numbers::ceil, 1},
    {Op::round, "round", numbers::round, 1},
    {Op::exp, "exp", numbers::exp, 1},
    {Op::log, "log", numbers::log, 1},
    {Op::min, "min", numbers::min, 2},
    {Op::max, "max", numbers::max, 2},
    {Op::clamp, "clamp", numbers::clamp, 3},
    {Op::lerp, "lerp", numbers::lerp, 3},
    {Op::smoothstep, "smoothstep", numbers::smoothstep, 3},
    {Op::hypot, "hypot", numbers::hypot, 2},
}};

constexpr bool complete() {
  for (std::size_t i = 0; i < kKernels.size(); ++i) {
    const KernelRow& r = kKernels[i];
    if (static_cast<std::size_t>(r.op) != i || r.name.empty() || r.kernel == nullptr) return false;
  }
  return true;
}
static_assert(complete());

}  // namespace

const KernelRow& row(Op op) { return kKernels[static_cast<std::size_t>(op)]; }

}  // namespace rigc::eval
