// SPDX-License-Identifier: MIT
// The scene of a rig in RIGC_rig. Test: tests/gltf/rig_json_test.cpp
#include "gltf/rig_json_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_joints.h"
#include "gltf/rig_json_values.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;

constexpr std::int64_t kLargestNode = 2'000'000'000;

/// Whether children are listed as they come: each after its parent, in the order made.
bool children_as_made(const scene::Scene& scene, NodeId id) {
  const auto& children = scene[id].children;
  return std::is_sorted(children.begin(), children.end()) &&
         (children.empty() || children.front() > id);
}

/// Joint and command that the origin names where nothing else is said.
Origin usual_origin(const Rig& rig, const scene::Node& node) {
  if (node.is_skeleton()) return {{}, node.name, {}};
  const CommandRecord& command = rig.commands[node.command];
  return {{}, command.joint, command.id};
}

std::string node_text(const Rig& rig, NodeId id, PlaceWriter& places) {
  const scene::Node& node = rig.scene[id];
  json::Writer writer;
  writer.begin_object().member("kind", scene::spec(node.kind).name).member("name", node.name);
  if (rig.nodes[id.index] >= 0) writer.member("node", rig.nodes[id.index]);
  Identity identity = node.identity;
  identity.rig = rig.id;
  writer.member("identity", to_text(identity));
  write_identifiers(writer, node.ids, rig.skeleton.global);
  if (!node.is_skeleton()) writer.member("command", node.command);
  if (node.parent.valid()) writer.member("parent", node.parent.index);
  if (!children_as_made(rig.scene, id)) {
    writer.key("children").begin_array();
    for (NodeId child : node.children) writer.value(child.index);
    writer.end_array();
  }
  write_values(writer, rig.scene, id);
  const Origin usual = usual_origin(rig, node);
  if (node.origin.joint != usual.joint || node.origin.command != usual.command)
    writer.key("origin")
        .begin_array()
        .value(node.origin.joint)
        .value(node.origin.command)
        .end_array();
  places.write(writer, node.origin.span);
  return writer.end_object().take();
}

/// Parents and children as RIGC_rig gives them, checked.
struct Hierarchy {
  std::vector<std::int64_t> parents;                 ///< -1: none
  std::vector<std::vector<std::uint32_t>> children;  ///< only of those that list them
  std::vector<bool> listed;
};

/// Every node's way up ends, and soon enough.
void check_depths(const std::vector<json::Value>& items, const Hierarchy& hierarchy,
                  JsonReader& reader) {
  std::vector<std::size_t> depths(items.size(), 0);  // 0: not known
  std::vector<std::size_t> path;
  for (std::size_t i = 0; i < items.size(); ++i) {
    path.clear();
    std::size_t at = i;
    // The path is cut where it gets too long: a cycle is one case of that.
    while (depths[at] == 0 && path.size() <= kMostDepth) {
      path.push_back(at);
      if (hierarchy.parents[at] < 0) break;
      at = static_cast<std::size_t>(hierarchy.parents[at]);
    }
    std::size_t depth = depths[at];
    if (path.size() + depth > kMostDepth)
      return reader.fail(codes::kRigHierarchy, items[i],
                         "the node is its own ancestor, or more than 1,024 nodes are above it");
    for (auto node = path.rbegin(); node != path.rend(); ++node) depths[*node] = ++depth;
  }
}

void read_children(const std::vector<json::Value>& items, JsonReader& reader, Hierarchy& out) {
  const auto last = static_cast<std::int64_t>(items.size()) - 1;
  std::vector<std::size_t> counts(items.size(), 0);
  for (const std::int64_t parent : out.parents)
    if (parent >= 0) ++counts[static_cast<std::size_t>(parent)];
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i]["children"]) continue;
    out.listed[i] = true;
    std::set<std::int64_t> seen;
    for (const json::Value& item : reader.items(items[i], "children")) {
      std::int64_t child = 0;
      if (!reader.whole(item, 0, last, child)) continue;
      const bool mine =
          out.parents[static_cast<std::size_t>(child)] == static_cast<std::int64_t>(i);
      if (!mine || !seen.insert(child).second)
        reader.fail(codes::kRigHierarchy, item,
                    mine ? "the child is listed twice" : "the child names another parent");
      out.children[i].push_back(static_cast<std::uint32_t>(child));
    }
    if (reader.ok() && out.children[i].size() != counts[i])
      reader.fail(codes::kRigHierarchy, items[i]["children"],
                  fmt::format("{} children are listed, {} nodes name this parent",
                              out.children[i].size(), counts[i]));
  }
}

Hierarchy read_hierarchy(const std::vector<json::Value>& items, JsonReader& reader) {
  Hierarchy out;
  out.parents.assign(items.size(), -1);
  out.children.resize(items.size());
  out.listed.assign(items.size(), false);
  for (std::size_t i = 0; i < items.size(); ++i)
    reader.get(items[i], "parent", 0, static_cast<std::int64_t>(items.size()) - 1, out.parents[i]);
  read_children(items, reader, out);
  for (std::size_t i = 0; reader.ok() && i < items.size(); ++i) {
    const std::int64_t parent = out.parents[i];
    if (parent >= static_cast<std::int64_t>(i) && !out.listed[static_cast<std::size_t>(parent)])
      reader.fail(codes::kRigHierarchy, items[i]["parent"],
                  "the parent comes after the node and does not list it as a child");
  }
  if (reader.ok()) check_depths(items, out, reader);
  return out;
}

void read_origin(const json::Value& item, std::size_t index, JsonReader& reader,
                 PlaceReader& places, const Rig& rig, scene::Node& node) {
  node.origin = usual_origin(rig, node);
  std::vector<std::string> words;
  if (reader.get(item, "origin", words)) {
    if (words.size() != 2)
      return reader.fail(codes::kRigType, item["origin"], "an origin is [joint, command]");
    node.origin.joint = words[0];
    node.origin.command = words[1];
  }
  node.origin.span = places.read_node(item, index);
}

/// A node without hierarchy and values; empty where something is wrong. `keys`: of the skeleton's
/// joints.
std::optional<scene::Node> read_node(const json::Value& item, std::size_t index, JsonReader& reader,
                                     PlaceReader& places, const Rig& rig,
                                     const std::set<JointKey>& keys) {
  scene::Node node;
  std::string kind_name;
  const bool complete = reader.get(item, "kind", kind_name, Need::required) &&
                        reader.get(item, "name", node.name, Need::required) &&
                        reader.get(item, "identity", node.identity, Need::required);
  if (!complete) return std::nullopt;
  const auto kind = scene::parse_kind(kind_name);
  if (!kind) {
    reader.fail(codes::kRigWord, item["kind"],
                fmt::format("rigc knows no kind of node \"{}\"", printable(kind_name)));
    return std::nullopt;
  }
  node.kind = *kind;
  read_identifiers(item, reader, rig.skeleton.global, node.ids);
  reader.get(item, "command", 0, static_cast<std::int64_t>(rig.commands.size()) - 1, node.command);
  if (!node.is_skeleton()) node.module = rig.commands[node.command].module;
  read_origin(item, index, reader, places, rig, node);
  if (node.identity.rig != rig.id) {
    reader.fail(
        codes::kRigText, item["identity"],
        fmt::format("the identity is of rig {}, this is rig {}", node.identity.rig, rig.id));
    return std::nullopt;
  }
  const bool is_joint = node.kind == scene::Kind::joint && node.identity.command.empty();
  if (node.is_skeleton() && (!is_joint || keys.count(node.identity.owner) == 0)) {
    reader.fail(codes::kRigIndex, item,
                "no command made the node, and it is no joint of the skeleton");
    return std::nullopt;
  }
  return node;
}

/// Makes the nodes and hangs those under parents that list them; false where something was wrong.
bool make_nodes(const std::vector<json::Value>& items, const Hierarchy& hierarchy,
                JsonReader& reader, PlaceReader& places, Rig& rig, SceneMaker& maker) {
  std::set<Identity> identities;
  std::set<JointKey> keys;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints) keys.insert(joint.key);
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto node = read_node(items[i], i, reader, places, rig, keys);
    if (!node) continue;
    if (!identities.insert(node->identity).second)
      reader.fail(codes::kRigDuplicate, items[i]["identity"],
                  fmt::format("another node has the identity {} too", to_text(node->identity)));
    if (!reader.ok()) continue;
    const std::int64_t parent = hierarchy.parents[i];
    if (parent >= 0 && !hierarchy.listed[static_cast<std::size_t>(parent)])
      node->parent = NodeId{static_cast<std::uint32_t>(parent)};
    maker.make(std::move(*node));
    int gltf_node = -1;
    reader.get(items[i], "node", 0, kLargestNode, gltf_node);
    rig.nodes.push_back(gltf_node);
  }
  if (!reader.ok()) return false;
  for (std::size_t i = 0; i < items.size(); ++i)
    for (const std::uint32_t child : hierarchy.children[i])
      maker.reparent({child}, {static_cast<std::uint32_t>(i)});
  return true;
}

}  // namespace

void write_scene(json::Writer& writer, const Rig& rig, PlaceWriter& places) {
  writer.key("nodes").begin_array();
  for (const NodeId id : rig.scene.nodes()) writer.raw("\n" + node_text(rig, id, places));
  writer.end_array();
}

void read_scene(const json::Value& object, JsonReader& reader, PlaceReader& places, Rig& rig) {
  const auto items = reader.objects(object, "nodes", kMostNodes, Need::required);
  if (!reader.ok()) return;
  const Hierarchy hierarchy = read_hierarchy(items, reader);
  if (!reader.ok()) return;
  SceneMaker maker(rig.scene);
  if (!make_nodes(items, hierarchy, reader, places, rig, maker)) return;
  for (const NodeId id : rig.scene.nodes()) read_values(items[id.index], reader, maker, id);
  if (!reader.ok()) return;
  for (const NodeId id : rig.scene.nodes()) read_inputs(items[id.index], reader, maker, id);
}

}  // namespace rigc::gltf
