// SPDX-License-Identifier: MIT
// What the value of a plug comes from. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_plugs.h"

#include <algorithm>

#include "bake/transfer_targets.h"
#include "eval/rules.h"
#include "scene/hierarchy.h"

namespace rigc::bake {
namespace {

using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

bool is_transform(const scene::Scene& scene, NodeId id) {
  return scene::spec(scene[id].kind).is_transform;
}

/// What is connected into a plug, into its components, or into the whole that it is part of.
void add_sources(const scene::Scene& scene, const Plug& plug, std::vector<Plug>& out) {
  Plug whole = plug;
  whole.component = -1;
  const auto& inputs = scene[plug.node].inputs;
  const auto first =
      std::lower_bound(inputs.begin(), inputs.end(), whole,
                       [](const scene::Connection& c, const Plug& p) { return c.to < p; });
  for (auto at = first; at != inputs.end(); ++at) {
    Plug to = at->to;
    to.component = -1;
    if (to != whole) break;
    out.push_back(at->from);
  }
}

bool is_keyable(const scene::Scene& scene, const Plug& plug) {
  if (plug.attribute < scene::kUserAttributes || scene[plug.node].kind != scene::Kind::control)
    return false;
  return scene[plug.node].user[plug.attribute - scene::kUserAttributes].keyable &&
         !scene.source(plug);
}

}  // namespace

std::vector<Plug> needs_of(const scene::Scene& scene, const Plug& plug) {
  std::vector<Plug> out;
  if (scene.role(plug) != scene::Role::output) {
    add_sources(scene, plug, out);
    const bool rotation = is_transform(scene, plug.node) && plug.attribute == transform::kRotation;
    if (rotation) add_sources(scene, {plug.node, transform::kRotate}, out);
    return out;
  }
  if (!is_transform(scene, plug.node)) {
    const eval::KindRule& rule = eval::rule(scene[plug.node].kind);
    if (rule.reads_of) return rule.reads_of(scene, plug);
    return rule.reads ? rule.reads(scene, plug.node) : out;
  }
  if (plug.attribute == transform::kWorld) {
    for (const std::uint16_t own : {transform::kTranslate, transform::kRotation, transform::kScale})
      out.push_back({plug.node, own});
  }
  const NodeId above = scene::transform_above(scene, plug.node);
  if (above.valid()) out.push_back({above, transform::kWorld});
  return out;
}

std::set<Plug> attributes_behind(const scene::Scene& scene, const std::vector<Plug>& plugs) {
  std::set<Plug> found, seen;
  std::vector<Plug> open = plugs;
  while (!open.empty()) {
    const Plug plug = open.back();
    open.pop_back();
    if (!seen.insert(plug).second) continue;
    if (is_keyable(scene, plug)) found.insert(plug);
    for (const Plug& need : needs_of(scene, plug)) open.push_back(need);
  }
  return found;
}

}  // namespace rigc::bake
