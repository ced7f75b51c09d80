// SPDX-License-Identifier: MIT
// Writes a rig into a file. Test: tests/gltf/rig_test.cpp
#include "gltf/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/control_mesh.h"
#include "gltf/proxy_mesh.h"
#include "gltf/rig_check.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_orphans.h"
#include "gltf/rig_nodes.h"
#include "gltf/rig_replace.h"
#include "gltf/splice.h"
#include "gltf/split_weights.h"
#include "gltf/unmoved.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;

struct ArrayRow {
  const char* name;
  Slots Owned::Part::*slots;
};
constexpr ArrayRow kArrays[] = {{"meshes", &Owned::Part::meshes},
                                {"materials", &Owned::Part::materials},
                                {"skins", &Owned::Part::skins},
                                {"accessors", &Owned::Part::accessors},
                                {"bufferViews", &Owned::Part::buffer_views}};

/// Counts what a patch gave out since this was made.
class Given {
 public:
  explicit Given(const Patch& patch) : patch_(patch) {
    for (const ArrayRow& row : kArrays) before_.push_back(patch.given(row.name).size());
  }
  void move_to(Owned::Part& part) {
    for (std::size_t i = 0; i < before_.size(); ++i) {
      const std::vector<int> given = patch_.given(kArrays[i].name);
      while (before_[i] < given.size()) (part.*kArrays[i].slots).add(given[before_[i]++]);
    }
  }

 private:
  const Patch& patch_;
  std::vector<std::size_t> before_;
};

/// Takes a node of the file for each that is to be written, because their texts name one another:
/// joints and what carries them, proxies, what strip takes away. Gives the nodes of the proxies.
class NumberTaker {
 public:
  NumberTaker(Patch& patch, Rig& rig, const NodePlaces& places)
      : patch_(patch), rig_(rig), places_(places) {}

  std::vector<int> take(const NodePlan& plan, const std::vector<ProxyGroup>& groups) {
    std::vector<int> proxies;
    rig_.nodes = plan.foreign;
    for (const NodeId id : plan.stays) rig_.nodes[id.index] = number(place_of(id));
    for (const ProxyGroup& group : groups) {
      int& node = rig_.nodes[group.mesh.index];
      proxies.push_back(number(node < 0 ? place_of(group.mesh) : -1));
      if (node < 0) node = proxies.back();
    }
    move_to(rig_.owned.stays);
    for (const NodeId id : plan.goes) rig_.nodes[id.index] = number(place_of(id));
    for (Orphan& orphan : rig_.orphans) orphan.node = number(orphan.node);
    move_to(rig_.owned.goes);
    return proxies;
  }

 private:
  int place_of(NodeId id) const { return places_.nodes.empty() ? -1 : places_.nodes[id.index]; }
  int number(int place) {
    const int node = place >= 0 ? place : patch_.append("nodes", "{}");
    taken_.insert(node);
    return node;
  }
  void move_to(Owned::Part& part) {
    for (const int node : taken_) part.nodes.add(node);
    taken_.clear();
  }

  Patch& patch_;
  Rig& rig_;
  const NodePlaces& places_;
  std::set<int> taken_;
};

/// Appends meshes and skins of proxies and gives the texts of their nodes; empty where a number is
/// too large.
std::optional<std::vector<std::string>> write_proxies(Patch& patch, const Rig& rig,
                                                      const std::vector<ProxyGroup>& proxies,
                                                      Diagnostics& diagnostics) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    const NodeId mesh = proxies[i].mesh;
    // The first piece of a mesh stands for it.
    const bool first = i == 0 || proxies[i - 1].mesh != mesh;
    const std::string extras = first ? extras_text(rig, mesh) : std::string();
    const auto text = write_proxy(patch, rig.scene, rig.nodes, proxies[i], extras);
    if (!text) {
      diagnostics.report(codes::kNotWritable, rig.scene[mesh].origin.span,
                         fmt::format("the proxy mesh \"{}\" is larger than 1e30",
                                     printable(rig.scene[mesh].name)));
      return std::nullopt;
    }
    texts.push_back(*text);
  }
  return texts;
}

/// Mesh of each scene node: the shapes of controls.
std::vector<int> write_shapes(Patch& patch, const scene::Scene& scene) {
  namespace control = scene::control;
  std::vector<int> meshes(scene.size(), -1);
  ControlMeshes shapes(patch);
  for (const NodeId id : scene.nodes()) {
    const scene::Node& node = scene[id];
    if (node.kind != scene::Kind::control) continue;
    meshes[id.index] =
        shapes.mesh(std::get<std::vector<double>>(node.attributes[control::kPoints][0]),
                    std::get<math::Vec3>(node.attributes[control::kColor][0]),
                    std::get<std::string>(node.attributes[control::kShape][0]));
  }
  return meshes;
}

/// Scenes that hold the model's joints; the default scene, as -1, where no joint is the model's.
std::vector<int> scenes_of(const File& file, const NodePlan& plan) {
  const auto nodes = file.root()["nodes"].items();
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const json::Value& child : nodes[i]["children"].items())
      parents[static_cast<std::size_t>(child.integer().value_or(0))] = static_cast<int>(i);
  std::set<std::int64_t> tops;
  for (int node : plan.foreign) {
    if (node < 0) continue;
    while (parents[static_cast<std::size_t>(node)] >= 0)
      node = parents[static_cast<std::size_t>(node)];
    tops.insert(node);
  }
  if (tops.empty()) return {-1};
  std::vector<int> found;
  const auto scenes = file.root()["scenes"].items();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto roots = scenes[i]["nodes"].items();
    if (std::any_of(roots.begin(), roots.end(), [&](const json::Value& root) {
          return tops.count(root.integer().value_or(-1)) != 0;
        }))
      found.push_back(static_cast<int>(i));
  }
  return found;
}

void add_roots(Patch& patch, const std::vector<int>& scenes, int node) {
  for (const int scene : scenes)
    scene < 0 ? patch.add_child(-1, node) : patch.add_root(scene, node);
}

/// Hangs a node where the rig's roots hang.
void add_top(Patch& patch, const Rig& rig, const std::vector<int>& scenes, int node) {
  if (rig.ancestor >= 0)
    patch.add_child(rig.ancestor, node);
  else
    add_roots(patch, scenes, node);
}

/// A node of ours with what others added to it.
std::string with_additions(const std::string& text, const Additions& additions) {
  Diagnostics none;
  const auto document = json::parse(text, "", 0, none);
  if (!document) return text;
  std::string children, extras(document->root()["extras"].text());
  for (const json::Value& child : document->root()["children"].items())
    children += (children.empty() ? "" : ",") + std::string(child.text());
  for (const int child : additions.children)
    children += (children.empty() ? "" : ",") + std::to_string(child);
  for (const auto& [name, value] : additions.extras)
    if (!document->root()["extras"][name]) extras = with_member(extras, name, value);
  std::string out = text;
  if (!children.empty()) out = with_member(out, "children", '[' + children + ']');
  if (!extras.empty()) out = with_member(out, "extras", extras);
  for (const auto& [name, value] : additions.members)
    if (!document->root()[name]) out = with_member(out, name, value);
  return out;
}

void write_node(Patch& patch, int node, std::string text, const NodePlaces& places) {
  const auto additions = places.additions.find(node);
  if (additions != places.additions.end()) text = with_additions(text, additions->second);
  patch.replace("nodes", node, std::move(text));
}

void write_nodes(Patch& patch, const Rig& rig, const NodePlan& plan, const std::vector<int>& meshes,
                 const NodePlaces& places) {
  for (const auto* part : {&plan.stays, &plan.goes})
    for (const NodeId id : *part)
      write_node(patch, rig.nodes[id.index], node_text(rig, plan, id, meshes[id.index]), places);
}

/// Identities of the model's joints, and what hangs under them or under the ancestor.
void join_to_model(Patch& patch, const Rig& rig, const NodePlan& plan,
                   const std::vector<int>& scenes) {
  const auto nodes = patch.file().root()["nodes"].items();
  for (const NodeId id : rig.scene.nodes()) {
    const NodeId parent = plan.parents[id.index];
    if (const int foreign = plan.foreign[id.index]; foreign >= 0) {
      Identity identity = rig.scene[id].identity;
      identity.rig = rig.id;
      const json::Value& now = nodes[static_cast<std::size_t>(foreign)];
      if (!has_foreign_mark(now) && now["extras"]["rigc"].string() != to_text(identity))
        patch.set_extra(foreign, "rigc", json::quote(to_text(identity)));
    } else if (scene::spec(rig.scene[id].kind).is_transform) {
      if (parent.valid()) {
        if (plan.foreign[parent.index] >= 0)
          patch.add_child(plan.foreign[parent.index], rig.nodes[id.index]);
      } else {
        add_top(patch, rig, scenes, rig.nodes[id.index]);
      }
    }
  }
}

/// A file's text holds the rig as it was built; what animators set is on the nodes.
std::string rig_text(const Rig& rig, const Sources& sources) {
  if (rig.posed.empty()) return to_json(rig, sources);
  Rig built = rig;
  built.scene = built_scene(rig);
  return to_json(built, sources);
}

/// RIGC_rig with this rig in the place of the one with its id, if there is one, else behind the
/// others.
std::string extension_text(const Patch& patch, const Rig& rig, const Sources& sources) {
  const std::string before = patch.root_extension("RIGC_rig");
  std::vector<std::pair<std::int64_t, std::string>> rigs;
  Diagnostics none;
  const auto document = json::parse(before.empty() ? "{}" : before, "", 0, none);
  if (document) {
    for (const json::Value& item : document->root()["rigs"].items())
      rigs.emplace_back(item["id"].integer().value_or(-1), std::string(item.text()));
  }
  std::erase_if(rigs, [&](const auto& other) { return other.first == rig.id; });
  rigs.emplace_back(rig.id, rig_text(rig, sources));
  std::stable_sort(rigs.begin(), rigs.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  json::Writer writer;
  writer.begin_object().member("version", kRigVersionNumber);
  writer.key("before").raw(patch.before()).key("rigs").begin_array();
  for (const auto& [id, text] : rigs) writer.raw("\n" + text);
  return writer.end_array().end_object().take();
}

}  // namespace

bool Slots::contains(int index) const {
  return std::any_of(runs.begin(), runs.end(), [&](const Range& run) {
    return index >= run.first && index - run.first < run.count;
  });
}

void Slots::add(int index) {
  if (!runs.empty() && runs.back().first + runs.back().count == index)
    ++runs.back().count;
  else
    runs.push_back({index, 1});
}

bool write_rig(Patch& patch, Rig& rig, int ancestor, const NodePlaces& places,
               Diagnostics& diagnostics) {
  const trace::Span span("write rig");
  if (!check_writable(rig, diagnostics)) return false;
  const NodePlan plan = plan_nodes(rig, ancestor);
  const std::vector<ProxyGroup> proxies = proxy_groups(rig.scene, plan.roots);
  rig.ancestor = ancestor;
  rig.owned = {};
  const std::vector<int> numbers = NumberTaker(patch, rig, places).take(plan, proxies);
  Given given(patch);
  const auto proxy_nodes = write_proxies(patch, rig, proxies, diagnostics);
  if (!proxy_nodes) return false;
  const Movers movers = find_movers(patch, places.own);
  const std::set<NodeId> shared = split_weights(patch, rig, diagnostics);
  warn_of_unmoved(patch, rig, movers, shared, diagnostics);
  given.move_to(rig.owned.stays);
  const std::vector<int> meshes = write_shapes(patch, rig.scene);
  given.move_to(rig.owned.goes);
  write_nodes(patch, rig, plan, meshes, places);
  const std::vector<int> scenes = scenes_of(patch.file(), plan);
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    write_node(patch, numbers[i], (*proxy_nodes)[i], places);
    // Under a parent, validators warn: the transform of a skinned mesh's node is ignored.
    add_roots(patch, scenes, numbers[i]);
  }
  join_to_model(patch, rig, plan, scenes);
  for (const Orphan& orphan : rig.orphans) {
    write_node(patch, orphan.node, orphan_text(rig, orphan), places);
    add_top(patch, rig, scenes, orphan.node);
  }
  patch.set_root_extension("RIGC_rig", extension_text(patch, rig, diagnostics.sources()));
  return true;
}

bool write_rig(Patch& patch, Rig& rig, int ancestor, Diagnostics& diagnostics) {
  return write_rig(patch, rig, ancestor, {}, diagnostics);
}

}  // namespace rigc::gltf
