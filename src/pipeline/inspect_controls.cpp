// SPDX-License-Identifier: MIT
// Inspect: what animators can do with each control. Test: tests/pipeline/inspect_test.cpp
#include <map>

#include "pipeline/inspect_parts.h"
#include "scene/access.h"

namespace rigc::pipeline {
namespace {

using scene::NodeId;
namespace transform = scene::transform;

std::vector<NodeId> of_kind(const scene::Scene& scene, scene::Kind kind) {
  std::vector<NodeId> found;
  for (NodeId id : scene.nodes())
    if (scene[id].kind == kind) found.push_back(id);
  return found;
}

/// Attributes that animators can key, with their values now: whole, or component by component where
/// some are locked.
void write_attributes(json::Writer& w, const scene::Scene& scene, NodeId id) {
  const unsigned keyable = scene::keyable_bits(scene, id);
  const math::Trs local = scene.local(id);
  const auto angles = std::get<math::Vec3>(scene.value({id, transform::kRotate}));
  const math::Vec3 components[] = {local.translation, angles, local.scale};
  w.key("attributes").begin_object();
  for (unsigned i = 0; i < 3; ++i) {
    const unsigned bits = keyable >> (3 * i) & 7;
    if (bits == 7) {
      if (i == 0) w.key("translate").numbers(&local.translation.x, 3);
      if (i == 1) w.key("rotation").numbers(&local.rotation.x, 4);
      if (i == 2) w.key("scale").numbers(&local.scale.x, 3);
      continue;
    }
    for (unsigned c = 0; c < 3; ++c)
      if (bits & 1u << c) w.member(scene::component_name(3 * i + c), components[i][c]);
  }
  for (const scene::UserAttribute& attribute : scene[id].user)
    if (attribute.keyable) w.member(attribute.name, attribute.value);
  w.end_object();
}

void write_names(json::Writer& w, std::string_view key, const scene::Scene& scene, NodeId id,
                 std::uint16_t mask, bool (*includes)(const scene::UserAttribute&)) {
  const unsigned bits = scene::bits_at(scene, id, mask);
  w.key(key).begin_array();
  for (unsigned i = 0; i < scene::kAllComponents; ++i)
    if (bits & 1u << i) w.value(scene::component_name(i));
  for (const scene::UserAttribute& attribute : scene[id].user)
    if (includes(attribute)) w.value(attribute.name);
  w.end_array();
}

using LimitsOf = std::multimap<NodeId, NodeId>;  // limits nodes by what they limit

LimitsOf limits_of(const scene::Scene& scene) {
  LimitsOf out;
  for (NodeId id : of_kind(scene, scene::Kind::limits))
    if (const auto limited = scene.source({id, scene::limits::kNode}))
      out.emplace(limited->node, id);
  return out;
}

void write_limits(json::Writer& w, const scene::Scene& scene, NodeId id, const LimitsOf& limits) {
  w.key("limits").begin_array();
  const auto [begin, end] = limits.equal_range(id);
  for (auto at = begin; at != end; ++at) {
    const auto bounds =
        std::get<std::vector<double>>(scene.value({at->second, scene::limits::kBounds}));
    for (std::size_t i = 0; i + 2 < bounds.size(); i += 3) {
      const bool channel = bounds[i] >= 0 && bounds[i] < scene::kAllComponents;
      if (!channel) continue;
      w.begin_object().member("attribute", scene::component_name(static_cast<unsigned>(bounds[i])));
      w.member(bounds[i + 1] == 0 ? "min" : "max", bounds[i + 2]).end_object();
    }
  }
  w.end_array();
}

}  // namespace

void write_controls(json::Writer& w, const gltf::Rig& rig) {
  const scene::Scene& scene = rig.scene;
  const LimitsOf limits = limits_of(scene);
  w.key("controls").begin_array();
  for (NodeId id : of_kind(scene, scene::Kind::control)) {
    const scene::Node& node = scene[id];
    const auto opposite = std::get<std::string>(scene.value({id, scene::control::kOpposite}));
    w.begin_object().member("node", rig.nodes[id.index]).member("identity", to_text(node.identity));
    w.member("name", node.name).member("local", node.ids.local).member("label", node.ids.label);
    w.member("module", node.module)
        .member("id", node.identity.command)
        .member("role", node.identity.role);
    w.member("opposite", opposite);
    write_attributes(w, scene, id);
    write_names(w, "locked", scene, id, scene::control::kLocked,
                [](const scene::UserAttribute& attribute) { return !attribute.keyable; });
    write_names(w, "hidden", scene, id, scene::control::kHidden,
                [](const scene::UserAttribute& attribute) { return attribute.hidden; });
    write_limits(w, scene, id, limits);
    w.end_object();
  }
  w.end_array();
}

}  // namespace rigc::pipeline
