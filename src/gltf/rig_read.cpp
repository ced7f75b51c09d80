// SPDX-License-Identifier: MIT
// Reads the rigs of a file: their text, then what the nodes say. Test: tests/gltf/rig_read_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/rig.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_orphans.h"
#include "gltf/rig_json_reader.h"
#include "gltf/rig_pose.h"
#include "gltf/slim.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;

Place at_node(const File& file, int node) { return {file.path, fmt::format("/nodes/{}", node)}; }

/// A rig and where its text stands.
struct Text {
  Rig rig;
  std::string pointer;
};

/// What the nodes of a file say that they are.
struct Identities {
  std::map<Identity, int> nodes;
  std::vector<bool> marked;  ///< by glTF node: it says what it is
};

std::optional<Identities> read_identities(const File& file, const std::vector<json::Value>& nodes,
                                          Diagnostics& diagnostics) {
  Identities out;
  out.marked.assign(nodes.size(), false);
  bool unique = true;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto text = nodes[i]["extras"]["rigc"].string();
    const auto identity = text ? parse_identity(*text) : std::nullopt;
    if (!identity) continue;
    out.marked[i] = true;
    const auto [at, is_new] = out.nodes.emplace(*identity, static_cast<int>(i));
    if (is_new) continue;
    unique = false;
    diagnostics.report(
        codes::kSameIdentity, at_node(file, static_cast<int>(i)),
        fmt::format(
            "nodes {} (\"{}\") and {} (\"{}\") both say that they are {}", at->second,
            printable(nodes[static_cast<std::size_t>(at->second)]["name"].string().value_or("")), i,
            printable(nodes[i]["name"].string().value_or("")), *text),
        "remove extras.rigc from the one that is a copy");
  }
  if (!unique) return std::nullopt;
  return out;
}

/// The node that stands for a scene node: the one that says so, else the one at the recorded index,
/// if that one does not say something else.
int find_node(const Identities& identities, const scene::Node& node, int recorded) {
  const auto found = identities.nodes.find(node.identity);
  if (found != identities.nodes.end()) return found->second;
  const bool trusted = recorded >= 0 && recorded < static_cast<int>(identities.marked.size()) &&
                       !identities.marked[static_cast<std::size_t>(recorded)];
  return trusted ? recorded : -1;
}

/// Sets rig.nodes to the nodes that there are.
bool resolve_nodes(const File& file, const Identities& identities, Text& text, std::set<int>& taken,
                   Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  Rig& rig = text.rig;
  const auto count = static_cast<int>(identities.marked.size());
  for (const NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    int& at = rig.nodes[id.index];
    const bool has_place =
        scene::spec(node.kind).is_transform || (node.kind == scene::Kind::mesh && at >= 0);
    const int recorded = at;
    const Place place(file.path, fmt::format("{}/nodes/{}", text.pointer, id.index));
    at = has_place ? find_node(identities, node, recorded) : -1;
    if (at < 0 && (recorded >= count || (recorded >= 0 && !has_place))) {
      diagnostics.report(
          codes::kRigIndex, place,
          fmt::format("\"{}\" of rig {} says that it is node {} of {}, which it cannot be",
                      printable(node.name), rig.id, recorded, count));
    } else if (at < 0 && has_place) {
      diagnostics.report(
          codes::kNodeLost, place,
          fmt::format("no node stands for \"{}\" of rig {}", printable(node.name), rig.id));
    } else if (at >= 0 && !taken.insert(at).second) {
      diagnostics.report(
          codes::kRigDuplicate, at_node(file, at),
          fmt::format("\"{}\" of rig {} says that it is node {}, and so does another",
                      printable(node.name), rig.id, at));
    }
  }
  return diagnostics.errors() == errors;
}

/// Joints of the model and the ancestor where they are now.
bool update_foreign_nodes(const File& file, const Slim& slim, Text& text,
                          Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  const auto count = static_cast<int>(slim.nodes.size());
  Rig& rig = text.rig;
  std::map<JointKey, int> by_key;
  bool found_root = false;
  for (const NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.is_skeleton()) by_key[node.identity.owner] = rig.nodes[id.index];
    const bool ours = scene::spec(node.kind).is_transform && !node.is_skeleton();
    if (found_root || !ours || node.parent.valid() || rig.nodes[id.index] < 0) continue;
    rig.ancestor = slim.node(rig.nodes[id.index]).parent;
    found_root = true;
  }
  const auto check = [&](int node, const std::string& member) {
    if (node >= count)
      diagnostics.report(codes::kRigIndex, Place(file.path, text.pointer + member),
                         fmt::format("there is no node {}: the file has {}", node, count));
  };
  for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i) {
    tags::TaggedJoint& joint = rig.skeleton.joints[i];
    const auto found = by_key.find(joint.key);
    if (joint.foreign_node >= 0 && found != by_key.end()) joint.foreign_node = found->second;
    check(joint.foreign_node, fmt::format("/joints/{}/foreign_node", i));
  }
  check(rig.ancestor, "/ancestor");
  return diagnostics.errors() == errors;
}

std::optional<std::vector<Text>> read_texts(const File& file, const json::Value& extension,
                                            Origins origins, Diagnostics& diagnostics) {
  const auto version = extension["version"].integer();
  if (!version || *version < 1 || *version > kRigVersionNumber) {
    const json::Value at = extension["version"] ? extension["version"] : extension;
    diagnostics.report(codes::kRigVersion, Place(file.path, at.pointer()),
                       version ? fmt::format("RIGC_rig has version {}; this rigc reads version {}",
                                             *version, kRigVersionNumber)
                               : std::string("RIGC_rig has no version that is a number"));
    return std::nullopt;
  }
  JsonReader reader(file.path, diagnostics);
  std::vector<Text> texts;
  std::set<std::uint32_t> ids;
  bool complete = true;
  std::size_t node_count = 0, room = kMostParts;
  for (const json::Value& item : reader.objects(extension, "rigs", kMostRigs, Need::required)) {
    node_count += item["nodes"].size();
    if (node_count > kMostNodes) {
      reader.fail(codes::kRigTooLarge, item["nodes"],
                  fmt::format("all rigs together have more than {} nodes", kMostNodes));
      break;
    }
    auto rig = from_json(item, file.path, diagnostics, origins, &room);
    complete = complete && rig;
    if (!rig) continue;
    if (!ids.insert(rig->id).second)
      reader.fail(codes::kRigDuplicate, item["id"], fmt::format("there are two rigs {}", rig->id));
    texts.push_back({std::move(*rig), item.pointer()});
  }
  if (!complete || !reader.ok()) return std::nullopt;
  std::stable_sort(texts.begin(), texts.end(),
                   [](const Text& a, const Text& b) { return a.rig.id < b.rig.id; });
  return texts;
}

}  // namespace

std::optional<std::vector<Rig>> read_rigs(const File& file, Diagnostics& diagnostics,
                                          Origins origins, const Slim* known) {
  const trace::Span span("read rigs");
  const json::Value extension = file.root()["extensions"]["RIGC_rig"];
  if (!extension) return std::vector<Rig>();
  auto texts = read_texts(file, extension, origins, diagnostics);
  const auto nodes = file.root()["nodes"].items();
  const auto identities = read_identities(file, nodes, diagnostics);
  if (!texts || !identities) return std::nullopt;
  const auto own = known ? std::nullopt : read_slim(file, diagnostics, false);
  if (!known && !own) return std::nullopt;
  const Slim* const slim = known ? known : &*own;
  std::set<int> taken;
  bool complete = true;
  std::vector<Rig> rigs;
  for (Text& text : *texts) {
    complete = resolve_nodes(file, *identities, text, taken, diagnostics) && complete;
    complete = update_foreign_nodes(file, *slim, text, diagnostics) && complete;
    if (complete) find_orphans(file, *slim, nodes, text.rig, taken, diagnostics);
    if (complete) take_over_pose(file, *slim, nodes, text.rig, diagnostics);
    rigs.push_back(std::move(text.rig));
  }
  if (!complete) return std::nullopt;
  return rigs;
}

}  // namespace rigc::gltf
