// SPDX-License-Identifier: MIT
// The table of kernels, complete when compiled. This file is compiled once for each instruction set
// (cmake/kernels.cmake), with RIGC_ISA as its name. Test: tests/eval/isa_test.cpp
#include "eval/kernels/aim.h"
#include "eval/kernels/blend.h"
#include "eval/kernels/chain.h"
#include "eval/kernels/constraint.h"
#include "eval/kernels/limit.h"
#include "eval/kernels/numbers.h"
#include "eval/kernels/remap.h"
#include "eval/kernels/spline.h"
#include "eval/kernels/table.h"
#include "eval/kernels/transforms.h"
#include "eval/kernels/two_bone.h"
#include "eval/kernels/vectors.h"

namespace rigc::eval::RIGC_ISA {
namespace {

constexpr int kAny = -1;

template <class F>
constexpr Kernel unary = all_lanes<Unary<F>>;
template <class F>
constexpr Kernel binary = all_lanes<Binary<F>>;
template <class F>
constexpr Kernel ternary = all_lanes<Ternary<F>>;

constexpr KernelRow kRows[] = {
    {Op::compose, "compose", all_lanes<Compose>, 3},
    {Op::compose_rigid, "compose_rigid", all_lanes<ComposeRigid>, 2},
    {Op::compose_under, "compose_under", all_lanes<ComposeUnder>, 2},
    {Op::multiply, "multiply", all_lanes<Multiply>, 2},
    {Op::hang, "hang", all_lanes<Hang>, 2},
    {Op::hang_straight, "hang_straight", all_lanes<HangStraight>, 2},
    {Op::place, "place", all_lanes<Place>, 3},
    {Op::gather, "gather", all_lanes<Gather>, kAny},
    {Op::from_euler, "from_euler", all_lanes<FromEuler>, 1},
    {Op::to_euler, "to_euler", all_lanes<ToEuler>, 1},
    {Op::constraint, "constraint", all_lanes<Constraint>, kAny},
    {Op::aim, "aim", all_lanes<Aim>, kAny},
    {Op::blend, "blend", all_lanes<Blend>, kAny},
    {Op::aim_world, "aim_world", all_lanes<AimWorld>, kAny},
    {Op::ik_two_bone, "ik_two_bone", all_lanes<TwoBone>, 9},
    {Op::ik_chain, "ik_chain", all_lanes<Chain>, kAny},
    {Op::limit_vector, "limit_vector", all_lanes<LimitVector>, 1},
    {Op::limit_rotation, "limit_rotation", all_lanes<LimitRotation>, 1},
    {Op::spline, "spline", all_lanes<Spline>, kAny},
    {Op::remap, "remap", all_lanes<Remap>, 5},
    {Op::vector_add, "vector_add", all_lanes<VectorAdd>, 2},
    {Op::vector_subtract, "vector_subtract", all_lanes<VectorSubtract>, 2},
    {Op::vector_scale, "vector_scale", all_lanes<VectorScale>, 2},
    {Op::vector_multiply, "vector_multiply", all_lanes<VectorMultiply>, 2},
    {Op::vector_lerp, "vector_lerp", all_lanes<VectorLerp>, 3},
    {Op::dot, "dot", all_lanes<Dot>, 2},
    {Op::cross, "cross", all_lanes<Cross>, 2},
    {Op::length, "length", all_lanes<Length>, 1},
    {Op::normalise, "normalise", all_lanes<Normalise>, 1},
    {Op::rotation_multiply, "rotation_multiply", all_lanes<RotationMultiply>, 2},
    {Op::rotation_inverse, "rotation_inverse", all_lanes<RotationInverse>, 1},
    {Op::rotation_apply, "rotation_apply", all_lanes<RotationApply>, 2},
    {Op::rotation_slerp, "rotation_slerp", all_lanes<RotationSlerp>, 3},
    {Op::axis_angle, "axis_angle", all_lanes<AxisAngle>, 2},
    {Op::twist_angle, "twist_angle", all_lanes<TwistAngle>, 2},
    {Op::between, "between", all_lanes<Between>, 2},
    {Op::aim_rotation, "aim_rotation", all_lanes<AimRotation>, 2},
    {Op::matrix_rotation, "matrix_rotation", all_lanes<MatrixRotation>, 1},
    {Op::matrix_scale, "matrix_scale", all_lanes<MatrixScale>, 1},
    {Op::matrix_inverse, "matrix_inverse", all_lanes<MatrixInverse>, 1},
    {Op::transform_point, "transform_point", all_lanes<TransformPoint>, 2},
    {Op::transform_vector, "transform_vector", all_lanes<TransformVector>, 2},
    {Op::choose, "choose", all_lanes<Choose>, 3},
    {Op::negate, "negate", unary<numbers::Negate>, 1},
    {Op::logical_not, "not", unary<numbers::Not>, 1},
    {Op::add, "add", binary<numbers::Add>, 2},
    {Op::subtract, "subtract", binary<numbers::Subtract>, 2},
    {Op::multiply_numbers, "multiply_numbers", binary<numbers::Multiply>, 2},
    {Op::divide, "divide", binary<numbers::Divide>, 2},
    {Op::modulo, "modulo", binary<numbers::Modulo>, 2},
    {Op::power, "power", binary<numbers::Power>, 2},
    {Op::less, "less", binary<numbers::Less>, 2},
    {Op::less_equal, "less_equal", binary<numbers::LessEqual>, 2},
    {Op::greater, "greater", binary<numbers::Greater>, 2},
    {Op::greater_equal, "greater_equal", binary<numbers::GreaterEqual>, 2},
    {Op::equal, "equal", binary<numbers::Equal>, 2},
    {Op::not_equal, "not_equal", binary<numbers::NotEqual>, 2},
    {Op::logical_and, "and", binary<numbers::And>, 2},
    {Op::logical_or, "or", binary<numbers::Or>, 2},
    {Op::select, "select", ternary<numbers::Select>, 3},
    {Op::sin, "sin", unary<numbers::Sin>, 1},
    {Op::cos, "cos", unary<numbers::Cos>, 1},
    {Op::tan, "tan", unary<numbers::Tan>, 1},
    {Op::asin, "asin", unary<numbers::Asin>, 1},
    {Op::acos, "acos", unary<numbers::Acos>, 1},
    {Op::atan, "atan", unary<numbers::Atan>, 1},
    {Op::atan2, "atan2", binary<numbers::Atan2>, 2},
    {Op::sqrt, "sqrt", unary<numbers::Sqrt>, 1},
    {Op::abs, "abs", unary<numbers::Abs>, 1},
    {Op::sign, "sign", unary<numbers::Sign>, 1},
    {Op::floor, "floor", unary<numbers::Floor>, 1},
    {Op::ceil, "ceil", unary<numbers::Ceil>, 1},
    {Op::round, "round", unary<numbers::Round>, 1},
    {Op::exp, "exp", unary<numbers::Exp>, 1},
    {Op::log, "log", unary<numbers::Log>, 1},
    {Op::min, "min", binary<numbers::Min>, 2},
    {Op::max, "max", binary<numbers::Max>, 2},
    {Op::clamp, "clamp", ternary<numbers::Clamp>, 3},
    {Op::lerp, "lerp", ternary<numbers::Lerp>, 3},
    {Op::smoothstep, "smoothstep", ternary<numbers::Smoothstep>, 3},
    {Op::hypot, "hypot", binary<numbers::Hypot>, 2},
};

constexpr bool complete() {
  std::size_t count = 0;
  for (const KernelRow& row : kRows) {
    if (static_cast<std::size_t>(row.op) != count++ || row.name.empty()) return false;
  }
  return count == static_cast<std::size_t>(Op::count);
}
static_assert(complete());

}  // namespace

const KernelRow* kernels() { return kRows; }

}  // namespace rigc::eval::RIGC_ISA
