// SPDX-License-Identifier: MIT
// Which features move the model. Test: tests/pipeline/unmoved_test.cpp
#include "gltf/unmoved.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/accessor.h"
#include "gltf/rig_codes.h"
#include "gltf/slim.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

using json::Value;
using scene::Kind;
using scene::NodeId;

int index_of(const Value& value) { return static_cast<int>(value.integer().value_or(-1)); }

/// Reads which joints of a skin have weights.
class WeightReader {
 public:
  explicit WeightReader(const Patch& patch) : patch_(patch) {
    Diagnostics reading;
    slim_ = read_slim(patch.file(), reading, false);
  }

  /// Of what cannot be read every joint counts.
  void add(int skin, int mesh, std::set<int>& out) {
    const json::Document bound = parsed(patch_.element("skins", skin));
    std::vector<int> joints;
    for (const Value& joint : bound.root()["joints"].items()) joints.push_back(index_of(joint));
    const json::Document document = parsed(patch_.element("meshes", mesh));
    for (const Value& primitive : document.root()["primitives"].items())
      for (std::size_t set = 0;; ++set) {
        const Value of_joints = primitive["attributes"]["JOINTS_" + std::to_string(set)];
        const Value weights = primitive["attributes"]["WEIGHTS_" + std::to_string(set)];
        if (!of_joints || !weights) break;
        if (!done_.emplace(skin, index_of(of_joints), index_of(weights)).second) continue;
        if (primitive["extensions"]["KHR_draco_mesh_compression"] ||
            !add(joints, index_of(of_joints), index_of(weights), out))
          out.insert(joints.begin(), joints.end());
      }
  }

 private:
  bool add(const std::vector<int>& joints, int used, int weighted, std::set<int>& out) const {
    const auto used_numbers = read(used), weights = read(weighted);
    if (!used_numbers || !weights || used_numbers->size() != weights->size()) return false;
    std::vector<bool> found(joints.size(), false);
    for (std::size_t i = 0; i < weights->size(); ++i) {
      const auto joint = static_cast<std::size_t>((*used_numbers)[i]);
      if ((*weights)[i] > 0 && joint < found.size()) found[joint] = true;
    }
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (found[i]) out.insert(joints[i]);
    return true;
  }
  std::optional<std::vector<float>> read(int accessor) const {
    if (!slim_ || accessor < 0 || accessor >= static_cast<int>(slim_->accessors.size()))
      return std::nullopt;
    Diagnostics reading;
    return read_floats(patch_.file(), *slim_, accessor,
                       slim_->accessors[static_cast<std::size_t>(accessor)].count, reading);
  }

  const Patch& patch_;
  std::optional<Slim> slim_;
  std::set<std::tuple<int, int, int>> done_;  ///< skin, accessors
};

/// Some nodes of a scene and all that places them: what drives them, what they hang under.
class Behind {
 public:
  explicit Behind(const scene::Scene& scene) : scene_(scene), in_(scene.size(), false) {}
  void add(NodeId node) {
    std::vector<NodeId> open{node};
    while (!open.empty()) {
      const NodeId at = open.back();
      open.pop_back();
      if (!at.valid() || in_[at.index]) continue;
      in_[at.index] = true;
      open.push_back(scene_[at].parent);
      const bool is_transform = scene::spec(scene_[at].kind).is_transform;
      for (const scene::Connection& input : scene_[at].inputs)
        if (!is_transform || input.to.attribute != scene::transform::kVisible)
          open.push_back(input.from.node);
    }
  }
  bool has(NodeId node) const { return in_[node.index]; }

 private:
  const scene::Scene& scene_;
  std::vector<bool> in_;
};

constexpr std::size_t kMostGroups = 6;

/// ` in arm_l, arm_r`.
std::string in_groups(std::vector<std::string> groups) {
  std::erase(groups, "");
  if (groups.empty()) return {};
  const std::size_t more = groups.size() - std::min(groups.size(), kMostGroups);
  groups.resize(groups.size() - more);
  return " in " + printable(join(groups, ", "), 300) +
         (more > 0 ? fmt::format(" and {} more groups", more) : "");
}

/// What commands of one feature do in one group.
struct Use {
  bool drives = false;  ///< a joint
  bool moves = false;   ///< the model
};
struct Feature {
  bool declared = true;  ///< else a module that commands without a feature run
  Span span;
  std::map<std::string, Use> groups;
  bool could_share = false;  ///< it drives joints that would take a share of weights, if asked to
};

/// Nodes of the file with one below them that moves the model.
std::set<int> carriers(const File& file, const Movers& movers) {
  const auto nodes = file.root()["nodes"].items();
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const Value& child : nodes[i]["children"].items())
      parents[static_cast<std::size_t>(index_of(child))] = static_cast<int>(i);
  std::set<int> out;
  for (const auto* some : {&movers.skinned, &movers.rigid})
    for (int node : *some)
      for (; node >= 0 && out.insert(node).second;)
        node =
            node < static_cast<int>(parents.size()) ? parents[static_cast<std::size_t>(node)] : -1;
  return out;
}

class Finder {
 public:
  Finder(const Patch& patch, const Rig& rig, const Movers& movers, const std::set<NodeId>& shared)
      : rig_(rig), driving_(rig.scene), moving_(rig.scene), splitting_(rig.scene) {
    const std::set<int> carry = carriers(patch.file(), movers);
    for (const NodeId id : rig.scene.nodes()) {
      const Kind kind = rig.scene[id].kind;
      if (kind == Kind::joint) driving_.add(id);
      if (kind == Kind::morph || shared.contains(id) ||
          (scene::spec(kind).is_transform && carry.contains(rig.nodes[id.index])))
        moving_.add(id);
      if (kind == Kind::skin_split && !rig.settings.split_weights) add_joints(id, movers);
    }
  }

  std::map<std::string, Feature> find() {
    for (const NodeId id : rig_.scene.nodes())
      if (!rig_.scene[id].is_skeleton()) look_at(id);
    for (auto& [name, feature] : features_)
      if (!feature.declared && !splits_.contains(name)) feature.groups.clear();
    return std::move(features_);
  }

 private:
  /// Those that would take a share of the weights of a bone that has some.
  void add_joints(NodeId split, const Movers& movers) {
    const auto joint = [&](std::int32_t i) {
      const auto source = rig_.scene.source({split, scene::skin_split::kJoints, i});
      return source ? source->node : NodeId();
    };
    const NodeId bone = joint(0);
    if (!bone.valid() || !movers.skinned.contains(rig_.nodes[bone.index])) return;
    for (std::int32_t i = 2; joint(i).valid(); ++i) splitting_.add(joint(i));
  }
  void look_at(NodeId id) {
    const scene::Node& node = rig_.scene[id];
    const auto [name, group] = place_of(node);
    Feature& feature = features_[name.empty() ? node.module : name];
    feature.declared = !name.empty();
    if (!feature.span.known()) feature.span = node.origin.span;
    Use& use = feature.groups[group];
    use.drives = use.drives || driving_.has(id);
    use.moves = use.moves || moving_.has(id);
    feature.could_share = feature.could_share || splitting_.has(id);
    if (node.kind == Kind::skin_split) splits_.insert(node.module);
  }

  /// Feature and group of a command's node.
  std::pair<std::string, std::string> place_of(const scene::Node& node) const {
    if (node.command >= rig_.commands.size()) return {};
    const CommandRecord& record = rig_.commands[node.command];
    const int holder = rig_.skeleton.find(record.holder);
    if (holder < 0) return {};
    const tags::TaggedJoint& joint = rig_.skeleton.joints[static_cast<std::size_t>(holder)];
    for (const tags::CommandTag& command : joint.commands)
      if (command.id == record.id && command.feature >= 0)
        return {joint.features[static_cast<std::size_t>(command.feature)].name, joint.ids.local};
    return {"", joint.ids.local};
  }

  const Rig& rig_;
  Behind driving_, moving_, splitting_;
  std::map<std::string, Feature> features_;
  std::set<std::string> splits_;  ///< modules that make joints which could share weights
};

void warn_of_missing(const Rig& rig, Diagnostics& diagnostics) {
  std::set<std::string> tagged, said;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints)
    for (const tags::FeatureTag& feature : joint.features) tagged.insert(feature.name);
  for (const tags::Settings::Feature& asked : rig.settings.features)
    if (asked.on && !tagged.contains(asked.name) && said.insert(asked.name).second)
      diagnostics.report(
          codes::kMovesNothing, Place(),
          fmt::format("the feature \"{}\" moves no vertex of this model", printable(asked.name)),
          "the model has none of the joints that it is for");
}

}  // namespace

Movers find_movers(const Patch& patch, const std::set<int>& gone) {
  const trace::Span span("find movers");
  Movers out;
  std::set<std::pair<int, int>> bound;
  const auto nodes = patch.file().root()["nodes"].items();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int mesh = index_of(nodes[i]["mesh"]), skin = index_of(nodes[i]["skin"]);
    if (mesh < 0 || gone.contains(static_cast<int>(i))) continue;
    if (skin < 0 || skin >= patch.count("skins") || mesh >= patch.count("meshes"))
      out.rigid.insert(static_cast<int>(i));
    else
      bound.emplace(skin, mesh);
  }
  if (bound.empty()) return out;
  WeightReader reader(patch);
  for (const auto& [skin, mesh] : bound) reader.add(skin, mesh, out.skinned);
  return out;
}

void warn_of_unmoved(const Patch& patch, const Rig& rig, const Movers& movers,
                     const std::set<NodeId>& shared, Diagnostics& diagnostics) {
  if (movers.empty()) return;
  for (const auto& [name, feature] : Finder(patch, rig, movers, shared).find()) {
    std::vector<std::string> still;
    for (const auto& [group, use] : feature.groups)
      if (use.drives && !use.moves) still.push_back(group);
    if (still.empty()) continue;
    diagnostics.report(
        codes::kMovesNothing, feature.span,
        fmt::format("{} \"{}\" moves no vertex of this model{}",
                    feature.declared ? "the feature" : "the command", printable(name),
                    in_groups(still)),
        feature.could_share
            ? "`rigc build --split-weights`, or `rigc rebuild --split-weights on` where a rig is "
              "there, gives the new joints a share of their bones' weights"
            : "nothing that it drives has a weight in a skin, or a mesh below it");
  }
  warn_of_missing(rig, diagnostics);
}

}  // namespace rigc::gltf
