// SPDX-License-Identifier: MIT
// The rule of each kind, and what rules share. Test: tests/eval/compile_test.cpp
#include "eval/rules.h"

#include <array>

#include <fmt/format.h>
#include "base/text.h"
#include "eval/rules_of_kinds.h"

namespace rigc::eval {

namespace {

using scene::Kind;

constexpr std::array<KindRule, static_cast<std::size_t>(Kind::count)> kRules = {{
    {Kind::joint, nullptr, nullptr, nullptr},
    {Kind::transform, nullptr, nullptr, nullptr},
    {Kind::control, nullptr, nullptr, nullptr},
    {Kind::handle, nullptr, nullptr, nullptr},
    {Kind::point_constraint, constraint_reads, constraint_emit, constraint_place},
    {Kind::orient_constraint, constraint_reads, constraint_emit, constraint_place},
    {Kind::scale_constraint, constraint_reads, constraint_emit, constraint_place},
    {Kind::parent_constraint, constraint_reads, constraint_emit, constraint_place},
    {Kind::aim_constraint, aim_reads, aim_emit, aim_place},
    {Kind::ik_two_bone, two_bone_reads, two_bone_emit, two_bone_place},
    {Kind::ik_chain, chain_reads, chain_emit, chain_place},
    {Kind::expression, expression_reads, expression_emit, number_place},
    {Kind::remap, remap_reads, remap_emit, number_place},
    {Kind::mesh, nullptr, nullptr, nullptr},
    {Kind::limits, nullptr, nullptr, nullptr},
    {Kind::display_layer, nullptr, nullptr, nullptr},
    {Kind::control_set, nullptr, nullptr, nullptr},
    {Kind::compute, nullptr, nullptr, nullptr, compute_reads, compute_reads_with, compute_emit},
    {Kind::spline, spline_reads, spline_emit, spline_place},
    {Kind::skin_split, nullptr, nullptr, nullptr},
    {Kind::match, nullptr, nullptr, nullptr},
    {Kind::morph, nullptr, nullptr, nullptr},
    {Kind::spaces, nullptr, nullptr, nullptr},
}};

constexpr bool complete() {
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    const KindRule& r = kRules[i];
    const bool all = r.reads && r.emit && r.place;
    const bool none = !r.reads && !r.emit && !r.place;
    const bool each = r.reads_of && r.reads_with && r.emit_of;
    if (static_cast<std::size_t>(r.kind) != i || !(all || none)) return false;
    if ((r.reads_of || r.reads_with || r.emit_of) && !(each && none)) return false;
  }
  return true;
}
static_assert(complete());

}  // namespace

const KindRule& rule(Kind kind) { return kRules[static_cast<std::size_t>(kind)]; }

std::string describe_node(const scene::Scene& scene, scene::NodeId id) {
  const scene::Node& node = scene[id];
  std::string text = fmt::format("{} \"{}\"", spec(node.kind).name, printable(node.name));
  if (!node.origin.command.empty()) {
    text += fmt::format(", of command {} on joint {}", printable(node.origin.command),
                        printable(node.origin.joint));
  }
  return text;
}

}  // namespace rigc::eval
