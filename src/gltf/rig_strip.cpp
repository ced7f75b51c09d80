// SPDX-License-Identifier: MIT
// Takes rigs out of their file: what they appended goes where nothing else uses it.
// Test: tests/gltf/rig_strip_test.cpp
#include <algorithm>

#include "gltf/rig.h"
#include "gltf/rig_nodes.h"

namespace rigc::gltf {
namespace {

using json::Value;
using scene::NodeId;
using Indices = std::set<int>;

/// Elements of the file that go, by array.
struct Going {
  Indices nodes, meshes, materials, accessors, views;
};

int index_of(const Value& value) { return static_cast<int>(value.integer().value_or(-1)); }

/// Nodes of the rigs' part that goes, without those that carry something that stays: others may
/// have hung things there.
Indices going_nodes(const std::vector<Value>& nodes, const std::vector<Rig>& rigs) {
  Indices going;
  for (const Rig& rig : rigs) {
    for (const NodeId id : plan_nodes(rig, rig.ancestor).goes)
      if (rig.nodes[id.index] >= 0) going.insert(rig.nodes[id.index]);
  }
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const Value& child : nodes[i]["children"].items())
      parents[static_cast<std::size_t>(index_of(child))] = static_cast<int>(i);
  std::vector<bool> carries(nodes.size(), false);  // and so do all above it
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (going.count(static_cast<int>(i))) continue;
    for (int at = parents[i]; at >= 0 && !carries[static_cast<std::size_t>(at)];
         at = parents[static_cast<std::size_t>(at)])
      carries[static_cast<std::size_t>(at)] = true;
  }
  std::erase_if(going, [&](int node) { return carries[static_cast<std::size_t>(node)]; });
  return going;
}

/// Accessors that a mesh names.
Indices accessors_of(const Value& mesh) {
  Indices out;
  for (const Value& primitive : mesh["primitives"].items()) {
    for (const auto& [name, accessor] : primitive["attributes"].members())
      out.insert(index_of(accessor));
    for (const Value& target : primitive["targets"].items())
      for (const auto& [name, accessor] : target.members()) out.insert(index_of(accessor));
    if (primitive["indices"]) out.insert(index_of(primitive["indices"]));
  }
  return out;
}

Indices materials_of(const Value& mesh) {
  Indices out;
  for (const Value& primitive : mesh["primitives"].items())
    if (primitive["material"]) out.insert(index_of(primitive["material"]));
  return out;
}

Indices mesh_of(const Value& node) {
  return node["mesh"] ? Indices{index_of(node["mesh"])} : Indices{};
}

Indices view_of(const Value& accessor) {
  return accessor["bufferView"] ? Indices{index_of(accessor["bufferView"])} : Indices{};
}

bool owned(const std::vector<Rig>& rigs, Range Owned::Part::*range, int index) {
  return std::any_of(rigs.begin(), rigs.end(),
                     [&](const Rig& rig) { return (rig.owned.goes.*range).contains(index); });
}

/// What the users that go name, the rigs own, and no user that stays names.
template <class Named>
Indices released(const std::vector<Value>& users, const Indices& going_users, Named named,
                 const std::vector<Rig>& rigs, Range Owned::Part::*range) {
  Indices going, staying;
  for (std::size_t i = 0; i < users.size(); ++i) {
    const bool goes = going_users.count(static_cast<int>(i)) != 0;
    for (const int index : named(users[i])) (goes ? going : staying).insert(index);
  }
  std::erase_if(going,
                [&](int index) { return staying.count(index) || !owned(rigs, range, index); });
  return going;
}

Going find_going(const File& file, const std::vector<Rig>& rigs) {
  const Value root = file.root();
  Going going;
  const auto nodes = root["nodes"].items();
  const auto meshes = root["meshes"].items();
  going.nodes = going_nodes(nodes, rigs);
  going.meshes = released(nodes, going.nodes, mesh_of, rigs, &Owned::Part::meshes);
  going.materials = released(meshes, going.meshes, materials_of, rigs, &Owned::Part::materials);
  going.accessors = released(meshes, going.meshes, accessors_of, rigs, &Owned::Part::accessors);
  for (const Value& skin : root["skins"].items())
    going.accessors.erase(index_of(skin["inverseBindMatrices"]));
  for (const Value& animation : root["animations"].items())
    for (const Value& sampler : animation["samplers"].items())
      for (const char* end : {"input", "output"}) going.accessors.erase(index_of(sampler[end]));
  const auto accessors = root["accessors"].items();
  going.views = released(accessors, going.accessors, view_of, rigs, &Owned::Part::buffer_views);
  for (const Value& image : root["images"].items())
    going.views.erase(index_of(image["bufferView"]));
  return going;
}

/// Cuts what is at the end of an array, puts placeholders for the rest.
void remove(Patch& patch, const File& file, std::string_view array, const Indices& going) {
  int size = patch.count(array);
  const bool at_end = size == static_cast<int>(file.root()[array].size());
  while (at_end && size > 0 && going.count(size - 1)) --size;
  patch.truncate(array, size);
  for (const int index : going)
    if (index < size) patch.replace(array, index, "");
}

void unlink_nodes(Patch& patch, const std::vector<Value>& nodes, const Value& scenes,
                  const Indices& going) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (going.count(static_cast<int>(i))) continue;
    for (const Value& child : nodes[i]["children"].items())
      if (going.count(index_of(child))) patch.remove_child(static_cast<int>(i), index_of(child));
  }
  for (const Value& scene : scenes.items())
    for (const Value& root : scene["nodes"].items())
      if (going.count(index_of(root))) patch.remove_child(-1, index_of(root));
}

/// Takes identities, attributes and shapes from nodes that stay.
void clean_nodes(Patch& patch, const std::vector<Value>& nodes, const Going& going,
                 const Rig& rig) {
  const NodePlan plan = plan_nodes(rig, rig.ancestor);
  for (const NodeId id : rig.scene.nodes()) {
    const int node = rig.nodes[id.index];
    if (node < 0 || going.nodes.count(node)) continue;
    patch.set_extra(node, "rigc", "");
    for (const scene::UserAttribute& attribute : rig.scene[id].user)
      if (attribute.keyable && plan.foreign[id.index] < 0)
        patch.set_extra(node, attribute.name, "");
    const int mesh = index_of(nodes[static_cast<std::size_t>(node)]["mesh"]);
    if (rig.scene[id].kind == scene::Kind::control && owned({rig}, &Owned::Part::meshes, mesh))
      patch.set_member("nodes", node, "mesh", "");
  }
}

/// The texts of the rigs that stay; empty where none does.
std::string remaining_rigs(const std::string& extension, const std::vector<Rig>& stripped) {
  Diagnostics none;
  const auto document = json::parse(extension, "", 0, none);
  if (!document) return {};
  json::Writer writer;
  std::size_t count = 0;
  writer.begin_object().key("version").raw(document->root()["version"].text());
  writer.key("rigs").begin_array();
  for (const Value& item : document->root()["rigs"].items()) {
    const bool goes = std::any_of(stripped.begin(), stripped.end(), [&](const Rig& rig) {
      return item["id"].integer() == static_cast<std::int64_t>(rig.id);
    });
    if (goes) continue;
    writer.raw("\n" + std::string(item.text()));
    ++count;
  }
  writer.end_array().end_object();
  return count == 0 ? std::string() : writer.take();
}

}  // namespace

std::set<int> strip_rigs(Patch& patch, const File& file, const std::vector<Rig>& rigs) {
  const auto nodes = file.root()["nodes"].items();
  const Going going = find_going(file, rigs);
  for (const Rig& rig : rigs) clean_nodes(patch, nodes, going, rig);
  unlink_nodes(patch, nodes, file.root()["scenes"], going.nodes);
  remove(patch, file, "nodes", going.nodes);
  remove(patch, file, "meshes", going.meshes);
  remove(patch, file, "materials", going.materials);
  remove(patch, file, "accessors", going.accessors);
  remove(patch, file, "bufferViews", going.views);
  patch.set_root_extension("RIGC_rig", remaining_rigs(patch.root_extension("RIGC_rig"), rigs));
  return going.nodes;
}

}  // namespace rigc::gltf
