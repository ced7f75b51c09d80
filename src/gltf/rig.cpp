// SPDX-License-Identifier: MIT
// Writes a rig into a file. Test: tests/gltf/rig_test.cpp
#include "gltf/rig.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "gltf/control_mesh.h"
#include "gltf/proxy_mesh.h"
#include "gltf/rig_check.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_nodes.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;

struct ArrayRow {
  const char* name;
  Range Owned::Part::*range;
};
constexpr ArrayRow kArrays[] = {{"meshes", &Owned::Part::meshes},
                                {"materials", &Owned::Part::materials},
                                {"skins", &Owned::Part::skins},
                                {"accessors", &Owned::Part::accessors},
                                {"bufferViews", &Owned::Part::buffer_views}};

/// Sets the ranges of a part to what the arrays have from now on.
void begin_part(const Patch& patch, Owned::Part& part) {
  for (const ArrayRow& row : kArrays) part.*row.range = {patch.count(row.name), 0};
}

void end_part(const Patch& patch, Owned::Part& part) {
  for (const ArrayRow& row : kArrays) {
    Range& range = part.*row.range;
    range.count = patch.count(row.name) - range.first;
    if (range.count == 0) range = {};
  }
}

/// Gives every scene node its glTF node, in the order in which they will be appended.
void number_nodes(Rig& rig, const NodePlan& plan, int first,
                  const std::vector<ProxyGroup>& proxies) {
  rig.nodes = plan.foreign;
  int next = first;
  for (const NodeId id : plan.stays) rig.nodes[id.index] = next++;
  for (const ProxyGroup& group : proxies) {
    int& node = rig.nodes[group.mesh.index];
    if (node < 0) node = next;
    ++next;
  }
  for (const NodeId id : plan.goes) rig.nodes[id.index] = next++;
}

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

/// Joints and proxy meshes first, then what strip takes away.
void write_nodes(Patch& patch, Rig& rig, const NodePlan& plan, const std::vector<int>& meshes,
                 const std::vector<std::string>& proxies) {
  const auto append = [&](NodeId id) {
    patch.append("nodes", node_text(rig, plan, id, meshes[id.index]));
  };
  const int first = patch.count("nodes");
  for (const NodeId id : plan.stays) append(id);
  for (const std::string& text : proxies) {
    const int node = patch.append("nodes", text);
    // Under a parent, validators warn: the transform of a skinned mesh's node is ignored.
    patch.add_child(-1, node);
  }
  const int second = patch.count("nodes");
  for (const NodeId id : plan.goes) append(id);
  rig.owned.stays.nodes = {first, second - first};
  rig.owned.goes.nodes = {second, patch.count("nodes") - second};
}

/// Identities of the model's joints, and what hangs under them or under the ancestor.
void join_to_model(Patch& patch, const Rig& rig, const NodePlan& plan, int ancestor) {
  for (const NodeId id : rig.scene.nodes()) {
    const NodeId parent = plan.parents[id.index];
    if (plan.foreign[id.index] >= 0) {
      Identity identity = rig.scene[id].identity;
      identity.rig = rig.id;
      patch.set_extra(plan.foreign[id.index], "rigc", json::quote(to_text(identity)));
    } else if (scene::spec(rig.scene[id].kind).is_transform) {
      if (!parent.valid()) {
        patch.add_child(ancestor, rig.nodes[id.index]);
      } else if (plan.foreign[parent.index] >= 0) {
        patch.add_child(plan.foreign[parent.index], rig.nodes[id.index]);
      }
    }
  }
}

/// RIGC_rig with this rig in the place of the one with its id, if there is one, else behind the
/// others.
std::string extension_text(const std::string& before, const Rig& rig, const Sources& sources) {
  std::vector<std::pair<std::int64_t, std::string>> rigs;
  Diagnostics none;
  const auto document = json::parse(before.empty() ? "{}" : before, "", 0, none);
  if (document) {
    for (const json::Value& item : document->root()["rigs"].items())
      rigs.emplace_back(item["id"].integer().value_or(-1), std::string(item.text()));
  }
  std::erase_if(rigs, [&](const auto& other) { return other.first == rig.id; });
  rigs.emplace_back(rig.id, to_json(rig, sources));
  std::stable_sort(rigs.begin(), rigs.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  json::Writer writer;
  writer.begin_object().member("version", kRigVersionNumber).key("rigs").begin_array();
  for (const auto& [id, text] : rigs) writer.raw("\n" + text);
  return writer.end_array().end_object().take();
}

}  // namespace

bool write_rig(Patch& patch, Rig& rig, int ancestor, Diagnostics& diagnostics) {
  if (!check_writable(rig, diagnostics)) return false;
  const NodePlan plan = plan_nodes(rig, ancestor);
  const std::vector<ProxyGroup> proxies = proxy_groups(rig.scene, plan.roots);
  number_nodes(rig, plan, patch.count("nodes"), proxies);
  rig.ancestor = ancestor;
  rig.owned = {};
  rig.owned.buffer_length = patch.buffer_length();
  begin_part(patch, rig.owned.stays);
  const auto proxy_nodes = write_proxies(patch, rig, proxies, diagnostics);
  if (!proxy_nodes) return false;
  end_part(patch, rig.owned.stays);
  begin_part(patch, rig.owned.goes);
  const std::vector<int> meshes = write_shapes(patch, rig.scene);
  end_part(patch, rig.owned.goes);
  write_nodes(patch, rig, plan, meshes, *proxy_nodes);
  join_to_model(patch, rig, plan, ancestor);
  const std::string before = patch.root_extension("RIGC_rig");
  patch.set_root_extension("RIGC_rig", extension_text(before, rig, diagnostics.sources()));
  return true;
}

}  // namespace rigc::gltf
