// SPDX-License-Identifier: MIT
// Rigs and nodes as they are in a patch, and where what joins a rig is then. Test:
// tests/pipeline/merge_into_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "gltf/merge_codes.h"
#include "gltf/merge_into_parts.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

using json::Value;
using math::Affine;

math::Vec3 vector_of(const Value& list, math::Vec3 otherwise) {
  const auto items = list.items();
  if (items.size() != 3) return otherwise;
  return {items[0].number().value_or(0), items[1].number().value_or(0),
          items[2].number().value_or(0)};
}

Affine local_of(const Value& node) {
  const auto matrix = node["matrix"].items();
  const auto column = [&](std::size_t i) {
    return math::Vec3{matrix[4 * i].number().value_or(0), matrix[4 * i + 1].number().value_or(0),
                      matrix[4 * i + 2].number().value_or(0)};
  };
  if (matrix.size() == 16) return {{column(0), column(1), column(2)}, column(3)};
  math::Trs trs;
  trs.translation = vector_of(node["translation"], {});
  trs.scale = vector_of(node["scale"], {1, 1, 1});
  const auto turn = node["rotation"].items();
  if (turn.size() == 4)
    trs.rotation =
        math::normalised(math::Quat{turn[0].number().value_or(0), turn[1].number().value_or(0),
                                    turn[2].number().value_or(0), turn[3].number().value_or(1)});
  return math::compose(trs);
}

int root_above(const tags::TaggedSkeleton& skeleton, int joint) {
  while (skeleton.joints[static_cast<std::size_t>(joint)].parent >= 0)
    joint = skeleton.joints[static_cast<std::size_t>(joint)].parent;
  return joint;
}

/// Names that both lists have with different values, or the same list of names that both have where
/// any value clashes.
template <class List, class Same>
std::vector<std::string> clashes(const List& a, const List& b, Same same) {
  std::vector<std::string> out;
  for (const auto& one : a)
    for (const auto& other : b)
      if (same(one, other)) out.push_back(printable(one.first, 60));
  return out;
}

using Versions = std::vector<std::pair<std::string, int>>;

/// Pins of a rig that speak of modules of the other, which has another pin or none.
std::vector<std::string> foreign_pins(const Rig& rig, const Rig& other) {
  std::vector<std::string> out;
  const Versions& theirs = other.skeleton.module_pins;
  for (const auto& pin : rig.skeleton.module_pins) {
    const bool used = std::any_of(other.modules.begin(), other.modules.end(),
                                  [&](const auto& module) { return module.first == pin.first; });
    if (used && std::find(theirs.begin(), theirs.end(), pin) == theirs.end())
      out.push_back(printable(pin.first, 60));
  }
  return out;
}

class Clashes {
 public:
  Clashes(const Joining& joining, const std::string& path, Diagnostics& diagnostics)
      : into_(joining.into.rig), from_(joining.from.rig), path_(path), diagnostics_(diagnostics) {}

  bool run() {
    const std::size_t errors = diagnostics_.errors();
    joints();
    groups();
    const auto differ = [](const auto& a, const auto& b) {
      return a.first == b.first && a.second != b.second;
    };
    report(clashes(into_.modules, from_.modules, differ), "were built with other versions of");
    auto pins = foreign_pins(into_, from_);
    for (const std::string& pin : foreign_pins(from_, into_)) pins.push_back(pin);
    report(pins, "pin other versions of");
    shapes();
    roots();
    if (into_.skeleton.joints.size() + from_.skeleton.joints.size() > kMostJoints ||
        into_.scene.size() + from_.scene.size() > kMostNodes)
      diagnostics_.report(codes::kRigTooLarge, Place(path_), "the rigs are too large together");
    return diagnostics_.errors() == errors;
  }

 private:
  void joints() {
    std::set<JointKey> keys;
    for (const tags::TaggedJoint& joint : into_.skeleton.joints) keys.insert(joint.key);
    std::vector<std::string> both;
    for (const tags::TaggedJoint& joint : from_.skeleton.joints)
      if (keys.count(joint.key)) both.push_back(printable(joint.name, 60));
    report(both, "both have the joints");
  }

  void groups() {
    std::set<std::string> locals, both;
    for (const tags::TaggedJoint& joint : into_.skeleton.joints) locals.insert(joint.ids.local);
    for (const tags::TaggedJoint& joint : from_.skeleton.joints)
      if (!joint.ids.local.empty() && locals.count(joint.ids.local)) both.insert(joint.ids.local);
    report({both.begin(), both.end()}, "both have the local groups");
  }

  /// A rig has one root control: the next build would refuse a second.
  void roots() {
    const auto root = [](const Rig& rig) {
      return std::any_of(rig.commands.begin(), rig.commands.end(),
                         [](const CommandRecord& command) { return command.module == "root"; });
    };
    if (root(into_) && root(from_)) report({"root"}, "both have commands of the module");
  }

  void shapes() {
    std::vector<std::string> both;
    for (const tags::NamedShape& a : into_.skeleton.shapes)
      for (const tags::NamedShape& b : from_.skeleton.shapes)
        if (a.name == b.name && a.lines != b.lines) both.push_back(printable(a.name, 60));
    report(both, "have different shapes");
  }

  void report(std::vector<std::string> what, std::string_view why) {
    constexpr std::size_t kMostNamed = 8;
    if (what.empty()) return;
    const std::size_t more = what.size() - std::min(what.size(), kMostNamed);
    what.resize(what.size() - more);
    diagnostics_.report(codes::kRigsClash, Place(path_),
                        fmt::format("the rigs \"{}\" and \"{}\" {} {}{}", into_.skeleton.global,
                                    from_.skeleton.global, why, join(what, ", "),
                                    more > 0 ? fmt::format(" and {} more", more) : ""));
  }

  const Rig &into_, &from_;
  const std::string& path_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<PatchRigs> read_patch_rigs(const Patch& patch, const std::string& path,
                                         Diagnostics& diagnostics) {
  const std::string text = patch.root_extension("RIGC_rig");
  auto document = json::parse(text.empty() ? "{}" : text, path, 0, diagnostics);
  if (!document) return std::nullopt;
  PatchRigs out{std::make_unique<json::Document>(*std::move(document)), {}};
  for (const Value& item : out.text->root()["rigs"].items()) {
    auto rig = from_json(item, path, diagnostics);
    if (!rig) return std::nullopt;
    out.rigs.push_back({item, *std::move(rig)});
  }
  return out;
}

PatchNodes::PatchNodes(const Patch& patch) {
  const auto count = static_cast<std::size_t>(patch.count("nodes"));
  parents.assign(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const json::Document node = parsed(patch.element("nodes", static_cast<int>(i)));
    locals.push_back(local_of(node.root()));
    for (const Value& child : node.root()["children"].items())
      parents[static_cast<std::size_t>(child.integer().value_or(0))] = static_cast<int>(i);
    const auto mark = node.root()["extras"]["rigc"].string();
    if (const auto identity = mark ? parse_identity(*mark) : std::nullopt)
      marked.emplace(*identity, static_cast<int>(i));
  }
}

Affine PatchNodes::world(int node) const {
  Affine out;
  for (; node >= 0; node = parents[static_cast<std::size_t>(node)])
    out = locals[static_cast<std::size_t>(node)] * out;
  return out;
}

int PatchNodes::node_of(const Rig& rig, scene::NodeId id) const {
  if (!id.valid()) return -1;
  Identity identity = rig.scene[id].identity;
  identity.rig = rig.id;
  if (const auto found = marked.find(identity); found != marked.end()) return found->second;
  const int recorded = rig.nodes[id.index];
  return recorded < static_cast<int>(parents.size()) ? recorded : -1;
}

int PatchNodes::ancestor(const Rig& rig) const {
  for (const scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    const bool ours = scene::spec(node.kind).is_transform && !node.is_skeleton();
    const int at = ours && !node.parent.valid() ? node_of(rig, id) : -1;
    if (at >= 0) return parents[static_cast<std::size_t>(at)];
  }
  return rig.ancestor < static_cast<int>(parents.size()) ? rig.ancestor : -1;
}

scene::NodeId joint_node(const Rig& rig, const JointKey& key) {
  for (const scene::NodeId id : rig.scene.nodes())
    if (rig.scene[id].is_skeleton() && rig.scene[id].identity.owner == key) return id;
  return {};
}

Moved move_roots(const Joining& joining) {
  const Rig &into = joining.into.rig, &from = joining.from.rig;
  Moved out;
  for (const auto& [root, to] : joining.roots) {
    const Affine world = into.skeleton.world(static_cast<std::size_t>(to));
    const auto at = static_cast<std::size_t>(root);
    out.joints[root] = math::decompose(math::inverse(world) * joining.space *
                                       math::compose(from.skeleton.joints[at].rest));
  }
  for (const scene::NodeId id : from.scene.nodes()) {
    const scene::Node& node = from.scene[id];
    if (node.parent.valid() || !scene::spec(node.kind).is_transform) continue;
    const int owner = from.skeleton.find(node.identity.owner);
    const int to = owner < 0 ? joining.roots.begin()->second
                             : joining.roots.at(root_above(from.skeleton, owner));
    const auto& joint = into.skeleton.joints[static_cast<std::size_t>(to)];
    const scene::NodeId above = joint_node(into, joint.key);
    const Affine world = above.valid() ? into.scene.rest_world(above)
                                       : into.skeleton.world(static_cast<std::size_t>(to));
    out.nodes[id] = {
        to, math::decompose(math::inverse(world) * joining.space * from.scene.rest_world(id))};
  }
  return out;
}

bool check_distinct(const Joining& joining, const std::string& path, Diagnostics& diagnostics) {
  return Clashes(joining, path, diagnostics).run();
}

}  // namespace rigc::gltf
