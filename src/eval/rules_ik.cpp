// SPDX-License-Identifier: MIT
// Rules of the IK solvers. Test: tests/eval/compile_test.cpp
#include <algorithm>
#include <span>

#include <fmt/format.h>
#include "eval/kernels/table.h"
#include "eval/rules_of_kinds.h"

namespace rigc::eval {

namespace ik2 = scene::ik2;
namespace ik_chain_at = scene::ik_chain;

namespace {

constexpr double kMostIterations = 1000;
constexpr std::size_t kTwoBoneArguments = ik2::kMiddleScale + 1;

}  // namespace

/// Turns about the bones are read only where there may be some.
Plugs two_bone_reads(const scene::Scene& scene, scene::NodeId node) {
  Plugs plugs;
  for (std::uint16_t i = ik2::kBase; i <= ik2::kMiddleScale; ++i) plugs.push_back({node, i});
  const scene::Plug twists[] = {{node, ik2::kStartTwist}, {node, ik2::kMiddleTwist}};
  const bool twisted = std::any_of(
      std::begin(twists), std::end(twists),
      [&](const scene::Plug& plug) { return scene.source(plug) || scene.number(plug) != 0; });
  if (twisted) plugs.insert(plugs.end(), std::begin(twists), std::end(twists));
  return plugs;
}

std::optional<Operand> two_bone_emit(Emitter& emitter, const scene::Scene& scene,
                                     scene::NodeId node, const Operands& arguments,
                                     Diagnostics& diagnostics) {
  const std::size_t offsets = element_count(scene, node, ik2::kOffsets);
  if (offsets != 2) {
    return bad_node(scene, node, fmt::format("it has {} offsets, not 2", offsets), diagnostics);
  }
  std::vector<double> data;
  append(data, scene, node, ik2::kGoalOffset);
  append(data, scene, node, ik2::kOffsets);
  append(data, scene, node, ik2::kNormal);
  std::vector<Operand> nine(arguments.begin(), arguments.begin() + kTwoBoneArguments);
  const auto turns = std::span(arguments).subspan(std::min(arguments.size(), kTwoBoneArguments));
  const bool turned = std::any_of(turns.begin(), turns.end(), [&](const Operand& turn) {
    return !emitter.is_constant(turn) || emitter.numbers(turn)[0] != 0;
  });
  if (turned) {
    Operand& twists = nine[ik2::kTwist];
    twists = emitter.emit(Op::gather, {twists, turns[0], turns[1]}, {}, 3, node.index);
  }
  return emitter.emit(Op::ik_two_bone, nine, data, 24, node.index);
}

OutputPlace two_bone_place(const scene::Plug& output) {
  return {output.attribute == ik2::kStartWorld ? 0u : 12u, 12};
}

Plugs chain_reads(const scene::Scene& scene, scene::NodeId node) {
  Plugs plugs{{node, ik_chain_at::kBase},
              {node, ik_chain_at::kGoal},
              {node, ik_chain_at::kPole},
              {node, ik_chain_at::kTwist}};
  const auto count =
      static_cast<std::int32_t>(element_count(scene, node, ik_chain_at::kTranslates));
  for (std::int32_t i = 0; i < count; ++i) plugs.push_back({node, ik_chain_at::kTranslates, i});
  return plugs;
}

std::optional<Operand> chain_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                  const Operands& arguments, Diagnostics& diagnostics) {
  const std::size_t count = element_count(scene, node, ik_chain_at::kTranslates);
  const std::size_t rests = element_count(scene, node, ik_chain_at::kRests);
  if (count < 2 || count > kMaxChainJoints) {
    return bad_node(scene, node,
                    fmt::format("it has {} joints, not 2 to {}", count, kMaxChainJoints),
                    diagnostics);
  }
  if (rests != count) {
    return bad_node(scene, node, fmt::format("{} translates and {} rests", count, rests),
                    diagnostics);
  }
  const double iterations = scene.number({node, ik_chain_at::kIterations});
  if (!(iterations >= 0 && iterations <= kMostIterations)) {
    return bad_node(scene, node,
                    fmt::format("{} iterations, not 0 to {}", iterations, kMostIterations),
                    diagnostics);
  }
  std::vector<double> data{static_cast<double>(count), scene.number({node, ik_chain_at::kHasPole}),
                           iterations};
  append(data, scene, node, ik_chain_at::kGoalOffset);
  append(data, scene, node, ik_chain_at::kRests);
  const auto width = static_cast<std::uint32_t>(4 * (count - 1));
  return emitter.emit(Op::ik_chain, arguments, data, width, node.index);
}

OutputPlace chain_place(const scene::Plug& output) {
  return {4 * static_cast<std::uint32_t>(std::min(output.element, kMaxChainJoints)), 4};
}

}  // namespace rigc::eval
