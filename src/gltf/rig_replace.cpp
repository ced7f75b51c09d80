// SPDX-License-Identifier: MIT
// Replaces rigs of a file by their successors. Test: tests/gltf/rig_replace_test.cpp
#include "gltf/rig_replace.h"

#include <algorithm>
#include <array>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/rig_json_orphans.h"
#include "gltf/rig_nodes.h"

namespace rigc::gltf {
namespace {

using json::Value;
using scene::NodeId;

/// Members of a node that a rig writes itself.
constexpr std::array<std::string_view, 8> kOwnMembers = {
    "name", "translation", "rotation", "scale", "matrix", "mesh", "children", "extras"};

int index_of(const Value& value) { return static_cast<int>(value.integer().value_or(-1)); }

/// What a rig's own nodes are, to tell what others added.
struct Own {
  std::vector<bool> nodes;  ///< by glTF node
  const Rig& rig;
};

Additions additions_to(const Value& node, const std::vector<std::string>& attributes,
                       const Own& own) {
  Additions out;
  for (const auto& [name, value] : node.members()) {
    const bool plain = std::find(kOwnMembers.begin(), kOwnMembers.end(), name) != kOwnMembers.end();
    const bool shape = name == "mesh" && (own.rig.owned.goes.meshes.contains(index_of(value)) ||
                                          own.rig.owned.stays.meshes.contains(index_of(value)));
    const bool skin = name == "skin" && own.rig.owned.stays.skins.contains(index_of(value));
    if ((!plain && !skin) || (name == "mesh" && !shape))
      out.members.emplace_back(name, std::string(value.text()));
  }
  for (const Value& child : node["children"].items())
    if (!own.nodes[static_cast<std::size_t>(index_of(child))])
      out.children.push_back(index_of(child));
  for (const auto& [name, value] : node["extras"].members()) {
    const bool ours =
        name == "rigc" || std::find(attributes.begin(), attributes.end(), name) != attributes.end();
    if (!ours) out.extras.emplace_back(name, std::string(value.text()));
  }
  return out;
}

std::vector<std::string> names_of(const std::vector<scene::UserAttribute>& attributes) {
  std::vector<std::string> names;
  for (const scene::UserAttribute& attribute : attributes) names.push_back(attribute.name);
  return names;
}

/// Additions to the nodes of `old` that its successor keeps.
std::map<int, Additions> find_additions(const std::vector<Value>& nodes, const Rig& old,
                                        const std::set<int>& going, const std::set<int>& kept) {
  Own own{std::vector<bool>(nodes.size(), false), old};
  for (const std::set<int>* indices : {&going, &kept})
    for (const int node : *indices) own.nodes[static_cast<std::size_t>(node)] = true;
  std::map<int, Additions> out;
  const auto add = [&](int node, const std::vector<scene::UserAttribute>& attributes) {
    if (node < 0 || kept.count(node) == 0) return;
    Additions found =
        additions_to(nodes[static_cast<std::size_t>(node)], names_of(attributes), own);
    if (!found.members.empty() || !found.extras.empty() || !found.children.empty())
      out[node] = std::move(found);
  };
  for (const NodeId id : old.scene.nodes()) add(old.nodes[id.index], old.scene[id].user);
  for (const Orphan& orphan : old.orphans) add(orphan.node, orphan.attributes);
  return out;
}

}  // namespace

std::set<int> nodes_with_additions(const File& file, const Rig& rig) {
  const auto nodes = file.root()["nodes"].items();
  const Own own{std::vector<bool>(nodes.size(), true), rig};  // children do not count
  std::set<int> out;
  const auto look_at = [&](int node, const std::vector<scene::UserAttribute>& attributes) {
    if (node < 0) return;
    const Additions found =
        additions_to(nodes[static_cast<std::size_t>(node)], names_of(attributes), own);
    if (!found.members.empty() || !found.extras.empty()) out.insert(node);
  };
  for (const NodeId id : rig.scene.nodes()) look_at(rig.nodes[id.index], rig.scene[id].user);
  for (const Orphan& orphan : rig.orphans) look_at(orphan.node, orphan.attributes);
  return out;
}

std::vector<int> own_nodes(const Rig& rig) {
  std::vector<int> out = rig.nodes;
  const NodePlan plan = plan_nodes(rig, rig.ancestor);
  for (const NodeId id : rig.scene.nodes())
    if (plan.foreign[id.index] >= 0) out[id.index] = -1;
  return out;
}

bool replace_rigs(Patch& patch, const File& file, std::vector<Replacement>& replacements,
                  Diagnostics& diagnostics) {
  const trace::Span span("write rigs");
  const auto nodes = file.root()["nodes"].items();
  std::vector<const Rig*> old;
  Kept kept;
  for (const Replacement& one : replacements) {
    old.push_back(one.old);
    for (const int node : one.places)
      if (node >= 0) kept.nodes.insert(node);
    for (const Orphan& orphan : one.fresh->orphans)
      if (orphan.node >= 0) kept.nodes.insert(orphan.node);
    for (const tags::TaggedJoint& joint : one.fresh->skeleton.joints)
      if (joint.foreign_node >= 0) kept.joints.insert(joint.foreign_node);
  }
  const std::set<int> going = strip_but(patch, file, old, Strip::nothing, kept);
  for (Replacement& one : replacements) {
    NodePlaces places{one.places, find_additions(nodes, *one.old, going, kept.nodes), going};
    places.own.insert(kept.nodes.begin(), kept.nodes.end());
    for (const auto& [node, additions] : places.additions)
      if (std::any_of(additions.members.begin(), additions.members.end(),
                      [](const auto& member) { return member.first == "mesh"; }))
        places.own.erase(node);
    Diagnostics writing(one.sources);
    const bool written = write_rig(patch, *one.fresh, one.old->ancestor, places, writing);
    diagnostics.append(writing);
    if (!written) return false;
  }
  return true;
}

}  // namespace rigc::gltf
