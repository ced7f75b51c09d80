// SPDX-License-Identifier: MIT
// Which glTF node each scene node becomes, and the text of those that are ours.
// Test: tests/gltf/rig_test.cpp
#include "gltf/rig_nodes.h"

#include <algorithm>
#include <map>

#include "base/json.h"
#include "base/text.h"
#include "gltf/float_text.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;
using scene::Scene;

bool is_transform(const Scene& scene, NodeId id) {
  return scene::spec(scene[id].kind).is_transform;
}

/// Every node in the scene, parents first.
std::vector<NodeId> parents_first(const Scene& scene) {
  std::vector<NodeId> order, open;
  for (const NodeId root : scene.nodes()) {
    if (scene[root].parent.valid()) continue;
    open.push_back(root);
    while (!open.empty()) {
      const NodeId id = open.back();
      open.pop_back();
      order.push_back(id);
      const auto& children = scene[id].children;
      open.insert(open.end(), children.rbegin(), children.rend());
    }
  }
  return order;
}

std::vector<int> foreign_nodes(const Rig& rig) {
  std::map<JointKey, int> by_key;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints) by_key[joint.key] = joint.foreign_node;
  std::vector<int> foreign(rig.scene.size(), -1);
  for (const NodeId id : rig.scene.nodes()) {
    if (!rig.scene[id].is_skeleton()) continue;
    const auto found = by_key.find(rig.scene[id].identity.owner);
    if (found != by_key.end()) foreign[id.index] = found->second;
  }
  return foreign;
}

/// Joints of the skeleton, joints that commands hung under them, joints that proxy meshes are bound
/// to, and all that carries one of these.
std::vector<bool> staying(const Scene& scene, const std::vector<NodeId>& order) {
  std::vector<bool> stays(scene.size(), false);
  for (const NodeId id : order) {
    const scene::Node& node = scene[id];
    const bool on_joint = node.parent.valid() && stays[node.parent.index];
    if (node.is_skeleton() || (node.kind == scene::Kind::joint && on_joint)) stays[id.index] = true;
    if (node.kind != scene::Kind::mesh) continue;
    for (const scene::Connection& connection : node.inputs)
      stays[connection.from.node.index] = true;
  }
  for (auto id = order.rbegin(); id != order.rend(); ++id) {
    const NodeId parent = scene[*id].parent;
    if (stays[id->index] && parent.valid()) stays[parent.index] = true;
  }
  return stays;
}

void add_member(std::string& text, std::string_view name, const std::string& value) {
  if (text.size() > 1) text += ',';
  text += json::quote(name) + ':' + value;
}

}  // namespace

NodePlan plan_nodes(const Rig& rig, int ancestor) {
  const Scene& scene = rig.scene;
  const std::vector<NodeId> order = parents_first(scene);
  const std::vector<bool> stays = staying(scene, order);
  NodePlan plan;
  plan.foreign = foreign_nodes(rig);
  plan.roots.assign(scene.size(), -1);
  plan.parents.resize(scene.size());
  plan.children.resize(scene.size());
  for (const NodeId id : order) {
    const NodeId above = scene[id].parent;
    // What hangs under a constraint has its place where the constraint has its own.
    const bool skips = above.valid() && !is_transform(scene, above);
    const NodeId parent = plan.parents[id.index] = skips ? plan.parents[above.index] : above;
    if (!is_transform(scene, id)) continue;
    const bool foreign = plan.foreign[id.index] >= 0;
    // A joint of the model hangs under the model's joints, but not under nodes of ours.
    const bool follows = parent.valid() && (!foreign || plan.foreign[parent.index] >= 0);
    plan.roots[id.index] = ancestor >= 0 ? 0
                           : follows     ? plan.roots[parent.index]
                                         : static_cast<int>(id.index);
    if (foreign) continue;
    (stays[id.index] ? plan.stays : plan.goes).push_back(id);
    if (parent.valid()) plan.children[parent.index].push_back(id);
  }
  return plan;
}

bool has_foreign_mark(const json::Value& node) {
  const json::Value mark = node["extras"]["rigc"];
  return mark && !parse_identity(mark.string().value_or(""));
}

std::string extras_text(const std::string& mark,
                        const std::vector<scene::UserAttribute>& attributes) {
  std::string text = "{";
  add_member(text, "rigc", json::quote(mark));
  using Flavour = scene::UserAttribute::Flavour;
  for (const scene::UserAttribute& attribute : attributes) {
    if (!attribute.keyable) continue;
    const bool whole =
        attribute.flavour == Flavour::integer || attribute.flavour == Flavour::boolean;
    std::string number = number_text(attribute.value);
    // Other programs take a number without a point for an integer, and round its keys.
    if (!whole && number.find_first_of(".e") == std::string::npos) number += ".0";
    add_member(text, attribute.name, number);
  }
  return text + '}';
}

std::string extras_text(const Rig& rig, NodeId id) {
  Identity identity = rig.scene[id].identity;
  identity.rig = rig.id;
  return extras_text(to_text(identity), rig.scene[id].user);
}

std::string node_text(const Rig& rig, const NodePlan& plan, NodeId id, int mesh) {
  const scene::Node& node = rig.scene[id];
  std::string text = "{";
  if (!node.name.empty()) add_member(text, "name", json::quote(node.name));
  const bool posed = std::any_of(rig.posed.begin(), rig.posed.end(),
                                 [&](const Posed& one) { return one.plug.node == id; });
  math::Trs local = rig.scene.local(id);
  if (posed)
    local.rotation = std::get<math::Quat>(rig.scene.value({id, scene::transform::kRotation}));
  write_local(local, posed, [&](std::string_view name, const std::string& value) {
    add_member(text, name, value);
  });
  if (mesh >= 0) add_member(text, "mesh", std::to_string(mesh));
  std::string children;
  for (const NodeId child : plan.children[id.index])
    children += (children.empty() ? "" : ",") + std::to_string(rig.nodes[child.index]);
  if (!children.empty()) add_member(text, "children", '[' + children + ']');
  add_member(text, "extras", extras_text(rig, id));
  return text + '}';
}

}  // namespace rigc::gltf
