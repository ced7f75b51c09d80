// SPDX-License-Identifier: MIT
// Rules of the weighted constraints and of aim. Test: tests/eval/compile_test.cpp
#include <fmt/format.h>
#include "eval/codes.h"
#include "eval/kernels/constraint_table.h"
#include "eval/rules_of_kinds.h"
#include "eval/similarity.h"
#include "eval/values.h"

namespace rigc::eval {

namespace {

namespace constraint = scene::constraint;
namespace table = constraint_table;
namespace aim = scene::aim;

// Each target, then its weight.
void add_targets(const scene::Scene& scene, scene::NodeId node, std::uint16_t targets,
                 std::uint16_t weights, Plugs& plugs) {
  const auto count = static_cast<std::int32_t>(element_count(scene, node, targets));
  const auto weighted = static_cast<std::int32_t>(element_count(scene, node, weights));
  for (std::int32_t i = 0; i < count && i < weighted; ++i) {
    plugs.push_back({node, targets, i});
    plugs.push_back({node, weights, i});
  }
}

// Which of the targets take part where all weights are constant; those without weight never do.
std::vector<std::size_t> taking_part(const Emitter& emitter, const Operands& arguments,
                                     std::size_t count) {
  std::vector<std::size_t> all, weighted;
  bool constant = true;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(i);
    const Operand& weight = arguments[2 + 2 * i];
    constant = constant && emitter.is_constant(weight);
    if (constant && emitter.numbers(weight)[0] > 0) weighted.push_back(i);
  }
  return constant && !weighted.empty() ? weighted : all;
}

// Where parent and targets are rotations times factors that are known: what the short way needs.
void add_even(Emitter& emitter, const Operands& used, std::vector<double>& data) {
  const double parent = emitter.scale(used[0]);
  if (parent == 0) return;
  std::vector<double> more{1 / (parent * parent)};
  for (std::size_t i = 0; 1 + 2 * i < used.size(); ++i) {
    const double target = emitter.scale(used[1 + 2 * i]);
    const math::Affine offset = affine_from(data.data() + table::offset(i));
    if (target == 0 || !spans_space(offset.linear)) return;
    const math::Trs parts = math::decompose(offset);
    for (const double n : columns_of(math::matrix(parts.rotation)))
      more.push_back(n / (parent * target));
    const math::Vec3 scale = parts.scale * (target / parent);
    more.insert(more.end(), {scale.x, scale.y, scale.z});
  }
  data[table::kWay] = table::kEven;
  data.insert(data.end(), more.begin(), more.end());
}

}  // namespace

std::size_t element_count(const scene::Scene& scene, scene::NodeId node, std::uint16_t attribute) {
  return scene[node].attributes[attribute].size();
}

void append(std::vector<double>& data, const scene::Scene& scene, scene::NodeId node,
            std::uint16_t attribute) {
  for (scene::Value value : scene[node].attributes[attribute]) {
    if (auto* q = std::get_if<math::Quat>(&value)) *q = math::normalised(*q);
    const std::vector<double> numbers = numbers_of(value);
    data.insert(data.end(), numbers.begin(), numbers.end());
  }
}

std::nullopt_t bad_node(const scene::Scene& scene, scene::NodeId node, const std::string& message,
                        Diagnostics& diagnostics) {
  diagnostics.report(codes::kBadNode, scene[node].origin.span,
                     fmt::format("{}: {}", describe_node(scene, node), message));
  return std::nullopt;
}

Plugs constraint_reads(const scene::Scene& scene, scene::NodeId node) {
  Plugs plugs{{node, constraint::kParent}};
  add_targets(scene, node, constraint::kTargets, constraint::kWeights, plugs);
  return plugs;
}

std::optional<Operand> constraint_emit(Emitter& emitter, const scene::Scene& scene,
                                       scene::NodeId node, const Operands& arguments,
                                       Diagnostics& diagnostics) {
  const std::size_t count = element_count(scene, node, constraint::kTargets);
  const std::size_t weights = element_count(scene, node, constraint::kWeights);
  const std::size_t offsets = element_count(scene, node, constraint::kOffsets);
  if (count == 0) return bad_node(scene, node, "it has no targets", diagnostics);
  if (weights != count || offsets != count) {
    return bad_node(scene, node,
                    fmt::format("{} targets, {} weights and {} offsets", count, weights, offsets),
                    diagnostics);
  }
  const bool point = scene[node].kind == scene::Kind::point_constraint;
  std::vector<double> all_offsets;
  append(all_offsets, scene, node, constraint::kOffsets);
  const std::vector<std::size_t> targets = taking_part(emitter, arguments, count);
  std::vector<double> data{static_cast<double>(targets.size()),
                           point ? table::kPoint : table::kGeneral};
  Operands used{arguments[0]};
  for (const std::size_t i : targets) {
    used.insert(used.end(), {arguments[1 + 2 * i], arguments[2 + 2 * i]});
    const double* offset = all_offsets.data() + 12 * i;
    data.insert(data.end(), offset, offset + 12);
  }
  // What weighs alone weighs all.
  if (targets.size() == 1) used[2] = emitter.constant({1});
  if (!point) add_even(emitter, used, data);
  return emitter.emit(Op::constraint, used, data, 10, node.index);
}

OutputPlace constraint_place(const scene::Plug& output) {
  switch (output.attribute) {
    case constraint::kTranslate:
      return {0, 3};
    case constraint::kRotation:
      return {3, 4};
    case constraint::kScale:
      return {7, 3};
    default:
      return {3, 4, true};
  }
}

Plugs aim_reads(const scene::Scene& scene, scene::NodeId node) {
  Plugs plugs{
      {node, aim::kParent}, {node, aim::kPosition}, {node, aim::kUpTarget}, {node, aim::kUpVector}};
  add_targets(scene, node, aim::kTargets, aim::kWeights, plugs);
  return plugs;
}

std::optional<Operand> aim_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                const Operands& arguments, Diagnostics& diagnostics) {
  const std::size_t count = element_count(scene, node, aim::kTargets);
  const std::size_t weights = element_count(scene, node, aim::kWeights);
  if (count == 0) return bad_node(scene, node, "it has no targets", diagnostics);
  if (weights != count) {
    return bad_node(scene, node, fmt::format("{} targets and {} weights", count, weights),
                    diagnostics);
  }
  const double mode = scene.number({node, aim::kUpMode});
  if (mode != 0 && mode != 1 && mode != 2) {
    return bad_node(scene, node, fmt::format("up_mode is {}, not 0, 1 or 2", mode), diagnostics);
  }
  std::vector<double> data{static_cast<double>(count), mode};
  append(data, scene, node, aim::kOffset);
  return emitter.emit(Op::aim, arguments, data, 4, node.index);
}

OutputPlace aim_place(const scene::Plug& output) {
  return {0, 4, output.attribute == aim::kRotate};
}

}  // namespace rigc::eval
