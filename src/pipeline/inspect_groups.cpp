// SPDX-License-Identifier: MIT
// Inspect: layers and sets. Test: tests/pipeline/inspect_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "eval/evaluate.h"
#include "pipeline/inspect_parts.h"

namespace rigc::pipeline {
namespace {

using scene::NodeId;
namespace layer_at = scene::display_layer;
namespace set_at = scene::control_set;

struct Layer {
  NodeId id;
  std::string name, mode;
  bool visible = true;
  std::vector<double> color;
  std::vector<NodeId> members;
};

struct Set {
  std::string name, parent;
  std::vector<NodeId> members;
};

std::vector<NodeId> members_of(const scene::Scene& scene, NodeId id, std::uint16_t attribute) {
  std::vector<NodeId> members;
  const auto count = static_cast<std::int32_t>(scene[id].attributes[attribute].size());
  for (std::int32_t i = 0; i < count; ++i)
    if (const auto member = scene.source({id, attribute, i})) members.push_back(member->node);
  return members;
}

std::string text_at(const scene::Scene& scene, NodeId id, std::uint16_t attribute) {
  return std::get<std::string>(scene.value({id, attribute}));
}

/// Whether a layer is shown with the values that the controls have now.
bool is_visible(const scene::Scene& scene, NodeId layer) {
  const scene::Plug plug{layer, layer_at::kVisible};
  if (!scene.source(plug)) return scene.number(plug) != 0;
  Diagnostics ignored;  // `check` reports what cannot be computed
  const auto value = eval::evaluate(scene, {plug}, {}, ignored);
  return !value || std::get<double>(value->front()) != 0;
}

std::vector<Layer> layers_of(const scene::Scene& scene) {
  std::vector<Layer> layers;
  for (NodeId id : scene.nodes()) {
    if (scene[id].kind != scene::Kind::display_layer) continue;
    layers.push_back({id, text_at(scene, id, layer_at::kLayer), text_at(scene, id, layer_at::kMode),
                      is_visible(scene, id),
                      std::get<std::vector<double>>(scene.value({id, layer_at::kColor})),
                      members_of(scene, id, layer_at::kMembers)});
  }
  return layers;
}

std::vector<Set> sets_of(const scene::Scene& scene) {
  std::vector<Set> sets;
  for (NodeId id : scene.nodes()) {
    if (scene[id].kind != scene::Kind::control_set) continue;
    sets.push_back({text_at(scene, id, set_at::kSet), text_at(scene, id, set_at::kParent),
                    members_of(scene, id, set_at::kMembers)});
  }
  return sets;
}

void write_nodes(json::Writer& w, const gltf::Rig& rig, const std::vector<NodeId>& members) {
  w.key("nodes").begin_array();
  for (NodeId member : members) w.value(rig.nodes[member.index]);
  w.end_array();
}

void write_switch(json::Writer& w, const gltf::Rig& rig, NodeId layer) {
  const auto source = rig.scene.source({layer, layer_at::kVisible});
  if (!source) return;
  w.key("switch").begin_object().member("node", rig.nodes[source->node.index]);
  w.member("attribute", rig.scene.plug_name(*source)).end_object();
}

}  // namespace

void write_layers(json::Writer& w, const gltf::Rig& rig) {
  w.key("layers").begin_array();
  for (const Layer& layer : layers_of(rig.scene)) {
    w.begin_object().member("name", layer.name).member("visible", layer.visible);
    w.member("mode", layer.mode);
    if (!layer.color.empty()) w.key("color").numbers(layer.color.data(), layer.color.size());
    write_switch(w, rig, layer.id);
    write_nodes(w, rig, layer.members);
    w.end_object();
  }
  w.end_array();
}

void write_sets(json::Writer& w, const gltf::Rig& rig) {
  w.key("sets").begin_array();
  for (const Set& set : sets_of(rig.scene)) {
    w.begin_object().member("name", set.name).member("parent", set.parent);
    write_nodes(w, rig, set.members);
    w.end_object();
  }
  w.end_array();
}

std::string groups_text(const gltf::Rig& rig) {
  std::string out;
  for (const Layer& layer : layers_of(rig.scene)) {
    out += fmt::format("  layer     {} ({}) {}, {} nodes\n", printable(layer.name),
                       printable(layer.mode), layer.visible ? "shown" : "hidden",
                       layer.members.size());
  }
  for (const Set& set : sets_of(rig.scene)) {
    const std::string inside =
        set.parent.empty() ? "" : fmt::format(" in {}", printable(set.parent));
    out += fmt::format("  set       {}{}, {} controls\n", printable(set.name), inside,
                       set.members.size());
  }
  return out;
}

}  // namespace rigc::pipeline
