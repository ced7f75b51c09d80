// SPDX-License-Identifier: MIT
// Takes rigs out of their file: what they appended goes where nothing else uses it.
// Test: tests/gltf/rig_strip_test.cpp
#include <algorithm>

#include "base/trace.h"
#include "gltf/rebound.h"
#include "gltf/rig.h"
#include "gltf/rig_nodes.h"
#include "gltf/rig_replace.h"
#include "gltf/uses.h"

namespace rigc::gltf {
namespace {

using json::Value;
using scene::NodeId;
using Indices = std::set<int>;

/// Elements of the file that go, by array.
struct Going {
  Indices nodes, meshes, materials, skins;
};

using Rigs = std::vector<const Rig*>;

int index_of(const Value& value) { return static_cast<int>(value.integer().value_or(-1)); }

/// Proxy meshes: their nodes carry no identity where a mesh has several skins.
void add_proxies(const std::vector<Value>& nodes, const Rig& rig, Indices& going) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (rig.owned.stays.meshes.contains(index_of(nodes[i]["mesh"])) &&
        rig.owned.stays.skins.contains(index_of(nodes[i]["skin"])))
      going.insert(static_cast<int>(i));
}

/// How many joints of a skin are the model's: all, but where rigs that go added some.
std::size_t own_joints(const Rigs& rebound, int skin, std::size_t count) {
  for (const Rig* rig : rebound)
    for (const Rebound::Skin& changed : rig->rebound.skins)
      if (changed.skin == skin) count = std::min(count, static_cast<std::size_t>(changed.joints));
  return count;
}

/// Nodes that bend a skin which stays: they stay with it. `rebound`: rigs whose changes of skins
/// are undone.
Indices bones(const File& file, const Indices& going_skins, const Rigs& rebound) {
  Indices out;
  const auto skins = file.root()["skins"].items();
  for (std::size_t i = 0; i < skins.size(); ++i) {
    if (going_skins.count(static_cast<int>(i))) continue;
    auto joints = skins[i]["joints"].items();
    joints.resize(own_joints(rebound, static_cast<int>(i), joints.size()));
    for (const Value& joint : joints) out.insert(index_of(joint));
    if (skins[i]["skeleton"]) out.insert(index_of(skins[i]["skeleton"]));
  }
  return out;
}

/// Nodes of the rigs that go, without `staying` and those that carry something that stays: others
/// may have hung things there. What a kept node carries stays with it.
Indices going_nodes(const std::vector<Value>& nodes, const Rigs& rigs, Strip remains,
                    const Indices& staying, const Indices& kept) {
  Indices going;
  for (const Rig* rig : rigs) {
    const NodePlan plan = plan_nodes(*rig, rig->ancestor);
    for (const auto* part : {&plan.goes, &plan.stays}) {
      if (part == &plan.stays && remains == Strip::character) continue;
      for (const NodeId id : *part)
        if (rig->nodes[id.index] >= 0) going.insert(rig->nodes[id.index]);
    }
    for (const Orphan& orphan : rig->orphans) going.insert(orphan.node);
    if (remains == Strip::nothing) add_proxies(nodes, *rig, going);
  }
  for (const int node : staying) going.erase(node);
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const Value& child : nodes[i]["children"].items())
      parents[static_cast<std::size_t>(index_of(child))] = static_cast<int>(i);
  std::vector<bool> carries(nodes.size(), false);  // and so do all above it
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (going.count(static_cast<int>(i))) continue;
    for (int at = parents[i];
         at >= 0 && !carries[static_cast<std::size_t>(at)] && kept.count(at) == 0;
         at = parents[static_cast<std::size_t>(at)])
      carries[static_cast<std::size_t>(at)] = true;
  }
  std::erase_if(going, [&](int node) {
    return carries[static_cast<std::size_t>(node)] || kept.count(node) != 0;
  });
  return going;
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

Indices skin_of(const Value& node) {
  return node["skin"] ? Indices{index_of(node["skin"])} : Indices{};
}

/// Which elements of an array are the rigs' to take away.
struct Taking {
  const Rigs& rigs;
  Strip remains;
  const Rigs& rebound;  ///< those of the rigs whose changes of skins are undone
  bool operator()(Slots Owned::Part::*slots, int index) const {
    return std::any_of(rigs.begin(), rigs.end(), [&](const Rig* rig) {
      return (rig->owned.goes.*slots).contains(index) ||
             (remains == Strip::nothing && (rig->owned.stays.*slots).contains(index));
    });
  }
};

/// What the users that go name, the rigs own, and no user that stays names.
template <class Named>
Indices released(const std::vector<Value>& users, const Indices& going_users, Named named,
                 const Taking& taking, Slots Owned::Part::*slots) {
  Indices going, staying;
  for (std::size_t i = 0; i < users.size(); ++i) {
    const bool goes = going_users.count(static_cast<int>(i)) != 0;
    for (const int index : named(users[i])) (goes ? going : staying).insert(index);
  }
  std::erase_if(going, [&](int index) { return staying.count(index) || !taking(slots, index); });
  return going;
}

/// `going_skins`: bones of all others stay.
Going find_going(const File& file, const Taking& taking, const Indices& kept,
                 const Indices& going_skins) {
  Going going;
  const auto nodes = file.root()["nodes"].items();
  const auto meshes = file.root()["meshes"].items();
  going.nodes = going_nodes(nodes, taking.rigs, taking.remains,
                            bones(file, going_skins, taking.rebound), kept);
  Indices left = going.nodes;  // whose meshes and skins go: kept nodes get them anew
  left.insert(kept.begin(), kept.end());
  going.meshes = released(nodes, left, mesh_of, taking, &Owned::Part::meshes);
  going.skins = released(nodes, left, skin_of, taking, &Owned::Part::skins);
  going.materials = released(meshes, going.meshes, materials_of, taking, &Owned::Part::materials);
  return going;
}

/// A skin of ours that others use stays, its bones with it, and what these carry: all skins of ours
/// go at first, and fewer each time.
Going find_going(const File& file, const Taking& taking, const Indices& kept) {
  Indices skins;
  for (int i = 0; i < static_cast<int>(file.root()["skins"].size()); ++i)
    if (taking(&Owned::Part::skins, i)) skins.insert(i);
  for (;;) {
    Going going = find_going(file, taking, kept, skins);
    if (going.skins == skins) return going;
    skins = going.skins;
  }
}

/// Accessors and buffer views of meshes and skins that go, and of what is undone.
void release_data(Patch& patch, const File& file, const Going& going, const Taking& taking) {
  Uses uses(file);
  const auto drop = [&](int accessor) {
    if (taking(&Owned::Part::accessors, accessor)) uses.drop_accessor(patch, accessor, true);
  };
  const auto meshes = file.root()["meshes"].items();
  for (const int mesh : going.meshes)
    for (const int accessor : accessors_of(meshes[static_cast<std::size_t>(mesh)])) drop(accessor);
  const auto skins = file.root()["skins"].items();
  for (const int skin : going.skins)
    drop(index_of(skins[static_cast<std::size_t>(skin)]["inverseBindMatrices"]));
  for (const Rig* rig : taking.rebound) unbind(patch, rig->rebound, uses);
}

/// Kept nodes are linked anew, and their own lists written anew, by those who keep them.
void unlink_nodes(Patch& patch, const std::vector<Value>& nodes, const Value& scenes,
                  const Indices& going, const Indices& kept) {
  const auto leaves = [&](const Value& node) {
    return going.count(index_of(node)) != 0 || kept.count(index_of(node)) != 0;
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (going.count(static_cast<int>(i)) || kept.count(static_cast<int>(i))) continue;
    for (const Value& child : nodes[i]["children"].items())
      if (leaves(child)) patch.remove_child(static_cast<int>(i), index_of(child));
  }
  for (const Value& scene : scenes.items())
    for (const Value& root : scene["nodes"].items())
      if (leaves(root)) patch.remove_child(-1, index_of(root));
}

/// Takes identities, attributes and shapes from nodes that stay.
void clean_nodes(Patch& patch, const std::vector<Value>& nodes, const Going& going,
                 const Kept& kept, const Rig& rig) {
  const NodePlan plan = plan_nodes(rig, rig.ancestor);
  for (const NodeId id : rig.scene.nodes()) {
    const int node = rig.nodes[id.index];
    if (node < 0 || going.nodes.count(node) || kept.nodes.count(node)) continue;
    const bool marked = !has_foreign_mark(nodes[static_cast<std::size_t>(node)]);
    if (marked && kept.joints.count(node) == 0) patch.set_extra(node, "rigc", "");
    for (const scene::UserAttribute& attribute : rig.scene[id].user)
      if (attribute.keyable && plan.foreign[id.index] < 0)
        patch.set_extra(node, attribute.name, "");
    const int mesh = index_of(nodes[static_cast<std::size_t>(node)]["mesh"]);
    if (rig.scene[id].kind == scene::Kind::control && rig.owned.goes.meshes.contains(mesh))
      patch.set_member("nodes", node, "mesh", "");
  }
  for (const Orphan& orphan : rig.orphans)
    if (going.nodes.count(orphan.node) == 0 && kept.nodes.count(orphan.node) == 0)
      patch.set_extra(orphan.node, "rigc", "");
}

/// The texts of the rigs that stay; empty where none does.
std::string remaining_rigs(const Patch& patch, const Rigs& stripped) {
  const Value known = patch.file().root()["extensions"]["RIGC_rig"]["rigs"];
  if (known.size() == stripped.size()) return {};
  const std::string extension = patch.root_extension("RIGC_rig");
  Diagnostics none;
  const auto document = json::parse(extension, "", 0, none);
  if (!document) return {};
  json::Writer writer;
  std::size_t count = 0;
  writer.begin_object().key("version").raw(document->root()["version"].text());
  writer.key("before").raw(patch.before()).key("rigs").begin_array();
  for (const Value& item : document->root()["rigs"].items()) {
    const bool goes = std::any_of(stripped.begin(), stripped.end(), [&](const Rig* rig) {
      return item["id"].integer() == static_cast<std::int64_t>(rig->id);
    });
    if (goes) continue;
    writer.raw("\n" + std::string(item.text()));
    ++count;
  }
  writer.end_array().end_object();
  return count == 0 ? std::string() : writer.take();
}

}  // namespace

std::set<int> strip_but(Patch& patch, const File& file, const Rigs& rigs, Strip remains,
                        const Kept& kept) {
  const auto nodes = file.root()["nodes"].items();
  Rigs rebound;
  for (const Rig* rig : rigs)
    if (remains == Strip::nothing && is_rebound(file, *rig)) rebound.push_back(rig);
  const Taking taking{rigs, remains, rebound};
  const Going going = find_going(file, taking, kept.nodes);
  for (const Rig* rig : rigs) clean_nodes(patch, nodes, going, kept, *rig);
  unlink_nodes(patch, nodes, file.root()["scenes"], going.nodes, kept.nodes);
  release_data(patch, file, going, taking);
  const std::pair<const char*, const Indices*> arrays[] = {{"nodes", &going.nodes},
                                                           {"meshes", &going.meshes},
                                                           {"materials", &going.materials},
                                                           {"skins", &going.skins}};
  for (const auto& [array, indices] : arrays)
    for (const int index : *indices) patch.release(array, index);
  patch.set_root_extension("RIGC_rig", remaining_rigs(patch, rigs));
  return going.nodes;
}

std::set<int> strip_rigs(Patch& patch, const File& file, const std::vector<Rig>& rigs,
                         Strip remains) {
  const trace::Span span("strip rigs");
  Rigs pointers;
  for (const Rig& rig : rigs) pointers.push_back(&rig);
  return strip_but(patch, file, pointers, remains, {});
}

}  // namespace rigc::gltf
