// SPDX-License-Identifier: MIT
// Rules of programs: the instructions of the steps that an output needs, and no others.
// Test: tests/eval/compute_test.cpp
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include "eval/rules_of_kinds.h"

namespace rigc::eval {

namespace {

using scene::Formula;
using scene::FormulaOp;
namespace compute = scene::compute;

// The kernels of formulas of numbers have the order of FormulaOp from negate on.
constexpr Op number_kernel(FormulaOp op) {
  return static_cast<Op>(static_cast<int>(Op::negate) + static_cast<int>(op) -
                         static_cast<int>(FormulaOp::negate));
}
static_assert(number_kernel(FormulaOp::add) == Op::add &&
              number_kernel(FormulaOp::select) == Op::select &&
              number_kernel(FormulaOp::atan2) == Op::atan2 &&
              number_kernel(FormulaOp::round) == Op::round &&
              number_kernel(FormulaOp::hypot) == Op::hypot &&
              number_kernel(FormulaOp::vector_add) == Op::count);

struct KernelOf {
  FormulaOp op;
  Op kernel;
};
constexpr KernelOf kTyped[] = {
    {FormulaOp::vector_add, Op::vector_add},
    {FormulaOp::vector_subtract, Op::vector_subtract},
    {FormulaOp::vector_scale, Op::vector_scale},
    {FormulaOp::vector_multiply, Op::vector_multiply},
    {FormulaOp::vector_lerp, Op::vector_lerp},
    {FormulaOp::dot, Op::dot},
    {FormulaOp::cross, Op::cross},
    {FormulaOp::length, Op::length},
    {FormulaOp::normalise, Op::normalise},
    {FormulaOp::rotation_multiply, Op::rotation_multiply},
    {FormulaOp::rotation_inverse, Op::rotation_inverse},
    {FormulaOp::rotation_apply, Op::rotation_apply},
    {FormulaOp::rotation_slerp, Op::rotation_slerp},
    {FormulaOp::axis_angle, Op::axis_angle},
    {FormulaOp::twist_angle, Op::twist_angle},
    {FormulaOp::between, Op::between},
    {FormulaOp::aim_rotation, Op::aim_rotation},
    {FormulaOp::matrix_rotation, Op::matrix_rotation},
    {FormulaOp::matrix_scale, Op::matrix_scale},
    {FormulaOp::matrix_inverse, Op::matrix_inverse},
    {FormulaOp::transform_point, Op::transform_point},
    {FormulaOp::transform_vector, Op::transform_vector},
    {FormulaOp::choose, Op::choose},
    {FormulaOp::matrix_multiply, Op::multiply},
    {FormulaOp::compose, Op::compose},
    {FormulaOp::compose_rigid, Op::compose_rigid},
    {FormulaOp::from_euler, Op::from_euler},
    {FormulaOp::to_euler, Op::to_euler},
    {FormulaOp::gather, Op::gather},
};
constexpr bool in_order() {
  for (std::size_t i = 0; i < std::size(kTyped); ++i) {
    if (static_cast<std::size_t>(kTyped[i].op) !=
        static_cast<std::size_t>(FormulaOp::vector_add) + i)
      return false;
  }
  return std::size(kTyped) == static_cast<std::size_t>(FormulaOp::component) -
                                  static_cast<std::size_t>(FormulaOp::vector_add);
}
static_assert(in_order());

Op kernel_of(FormulaOp op) {
  if (op < FormulaOp::vector_add) return number_kernel(op);
  return kTyped[static_cast<std::size_t>(op) - static_cast<std::size_t>(FormulaOp::vector_add)]
      .kernel;
}

std::optional<Formula> parse(const scene::Scene& scene, scene::NodeId node,
                             Diagnostics& diagnostics) {
  const auto code = std::get<std::string>(scene.value({node, compute::kCode}));
  return scene::parse_program(code, scene[node].origin.span, diagnostics);
}

const Formula::Named* named(const Formula& formula, const scene::Plug& output) {
  for (const Formula::Named& out : formula.outputs) {
    if (compute::output_of(out.type) == output.attribute && out.element == output.element)
      return &out;
  }
  return nullptr;
}

scene::Plug input_plug(scene::NodeId node, const Formula::Named& input) {
  return {node, compute::input_of(input.type), input.element};
}

/// The inputs that a step needs, in the order in which the program names them.
std::vector<const Formula::Named*> needed_inputs(const Formula& formula, int step) {
  const std::vector<bool> needed = needed_steps(formula, step);
  std::vector<const Formula::Named*> inputs;
  for (const Formula::Named& input : formula.inputs) {
    if (needed[static_cast<std::size_t>(input.step)]) inputs.push_back(&input);
  }
  return inputs;
}

}  // namespace

Operand emit_steps(Emitter& emitter, const Formula& formula, int step, const Operands& inputs,
                   std::uint32_t node) {
  const std::vector<bool> needed = needed_steps(formula, step);
  Operands values(inputs);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const Formula::Step& at = formula.steps[i];
    if (!needed[i] || at.op == FormulaOp::input) continue;
    Operands arguments;
    for (const int argument : at.arguments) {
      if (argument >= 0) arguments.push_back(values[static_cast<std::size_t>(argument)]);
    }
    const auto width = static_cast<std::uint32_t>(scene::width(at.type));
    if (at.op == FormulaOp::constant) {
      values[i] = emitter.constant({at.value});
    } else if (at.op == FormulaOp::component) {
      values[i] = slice(arguments[0], static_cast<std::uint32_t>(at.input), width);
    } else {
      values[i] = emitter.emit(kernel_of(at.op), arguments, {}, width, node);
    }
  }
  return values[static_cast<std::size_t>(step)];
}

const Formula* Programs::of(const scene::Scene& scene, scene::NodeId node) {
  const auto [known, first_time] = by_node_.try_emplace(node.index, nullptr);
  if (!first_time) return known->second;
  const scene::Value code = scene.value({node, compute::kCode});
  const auto [at, is_new] = parsed_.try_emplace(std::get<std::string>(code));
  if (is_new) {
    Diagnostics unheard;
    at->second = parse(scene, node, unheard);
  }
  if (at->second) known->second = &*at->second;
  return known->second;
}

/// A program that is wrong reads nothing; compute_emit then reports it.
Plugs compute_reads_with(Programs& programs, const scene::Scene& scene, const scene::Plug& output) {
  Plugs plugs;
  const Formula* formula = programs.of(scene, output.node);
  const Formula::Named* out = formula ? named(*formula, output) : nullptr;
  if (!out) return plugs;
  for (const Formula::Named* input : needed_inputs(*formula, out->step)) {
    const std::size_t count = element_count(scene, output.node, compute::input_of(input->type));
    if (static_cast<std::size_t>(input->element) < count)
      plugs.push_back(input_plug(output.node, *input));
  }
  return plugs;
}

Plugs compute_reads(const scene::Scene& scene, const scene::Plug& output) {
  Programs programs;
  return compute_reads_with(programs, scene, output);
}

std::optional<Operand> compute_emit(Emitter& emitter, Programs& programs, const scene::Scene& scene,
                                    const scene::Plug& output, const Operands& arguments,
                                    Diagnostics& diagnostics) {
  const Formula* formula = programs.of(scene, output.node);
  if (!formula) {
    parse(scene, output.node, diagnostics);
    return std::nullopt;
  }
  const Formula::Named* out = named(*formula, output);
  if (!out) return bad_node(scene, output.node, "its program gives no such output", diagnostics);
  const auto needed = needed_inputs(*formula, out->step);
  if (needed.size() != arguments.size()) {
    return bad_node(scene, output.node, "it has fewer inputs than its program takes", diagnostics);
  }
  Operands inputs(formula->steps.size());
  for (std::size_t i = 0; i < needed.size(); ++i)
    inputs[static_cast<std::size_t>(needed[i]->step)] = arguments[i];
  return emit_steps(emitter, *formula, out->step, inputs, output.node.index);
}

}  // namespace rigc::eval
