// SPDX-License-Identifier: MIT
// Groups joints into skeletons.
// Test: tests/gltf/skeletons_test.cpp
#include "gltf/bones.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace rigc::gltf {
namespace {

/// Which joints belong together: disjoint sets, each led by its smallest joint.
class Groups {
 public:
  explicit Groups(std::size_t count) : leader_(count) {
    std::iota(leader_.begin(), leader_.end(), 0);
  }

  int leader(int node) {
    while (up(node) != node) {
      up(node) = up(up(node));
      node = up(node);
    }
    return node;
  }

  void unite(int a, int b) {
    const int first = leader(a);
    const int second = leader(b);
    up(std::max(first, second)) = std::min(first, second);
  }

 private:
  int& up(int node) { return leader_[static_cast<std::size_t>(node)]; }
  std::vector<int> leader_;
};

/// Collects the nodes of one skeleton after the other. Each node is claimed once, so that all of
/// them together cost no more than the file has nodes.
class Collector {
 public:
  Collector(const Slim& slim, const std::vector<bool>& is_joint, const std::vector<int>& above)
      : slim_(slim), is_joint_(is_joint), above_(above) {
    claimed_.resize(slim.nodes.size(), false);
    rank_.resize(slim.nodes.size(), 0);
    for (std::size_t i = 0; i < slim.preorder.size(); ++i)
      rank_[static_cast<std::size_t>(slim.preorder[i])] = i;
  }

  Bones collect(const std::vector<int>& joints) {
    Bones bones;
    std::vector<int> tops;
    for (int joint : joints)
      if (above_[static_cast<std::size_t>(joint)] < 0) tops.push_back(joint);
    bones.ancestor = common_ancestor(tops);
    for (int joint : joints)
      for (int i = joint; i >= 0 && i != bones.ancestor && claim(i, bones);
           i = slim_.node(i).parent) {
      }
    for (int joint : joints) claim_below(joint, bones);
    std::sort(bones.nodes.begin(), bones.nodes.end(),
              [&](int a, int b) { return rank(a) < rank(b); });
    return bones;
  }

  std::size_t rank(int node) const { return rank_[static_cast<std::size_t>(node)]; }

 private:
  bool claim(int node, Bones& bones) {
    if (claimed_[static_cast<std::size_t>(node)]) return false;
    claimed_[static_cast<std::size_t>(node)] = true;
    bones.nodes.push_back(node);
    return true;
  }

  /// Ends of bones, helpers and the like; what is drawn or seen through is no bone.
  void claim_below(int joint, Bones& bones) {
    std::vector<int> stack = slim_.node(joint).children;
    while (!stack.empty()) {
      const SlimNode& node = slim_.node(stack.back());
      const int index = stack.back();
      stack.pop_back();
      if (is_joint_[static_cast<std::size_t>(index)] || node.mesh >= 0 || node.camera >= 0)
        continue;
      claim(index, bones);
      stack.insert(stack.end(), node.children.begin(), node.children.end());
    }
  }

  /// Climbs from each top to where a path that was climbed before begins.
  int common_ancestor(const std::vector<int>& tops) const {
    std::map<int, std::size_t>
        height;  // steps above the first top at which a node's path joins its path
    std::vector<int> path;
    for (int i = slim_.node(tops[0]).parent; i >= 0; i = slim_.node(i).parent) {
      height[i] = path.size();
      path.push_back(i);
    }
    std::size_t common = 0;
    for (int top : tops) {
      std::vector<int> climbed;
      int i = slim_.node(top).parent;
      for (; i >= 0 && height.count(i) == 0; i = slim_.node(i).parent) climbed.push_back(i);
      const std::size_t joins = i < 0 ? path.size() : height[i];
      for (int node : climbed) height[node] = joins;
      common = std::max(common, joins);
    }
    return common < path.size() ? path[common] : -1;
  }

  const Slim& slim_;
  const std::vector<bool>& is_joint_;
  const std::vector<int>& above_;
  std::vector<bool> claimed_;
  std::vector<std::size_t> rank_;
};

void add_bone(std::vector<std::pair<std::string, int>>& bones, const json::Value& name_or_empty,
              const std::string& name, const json::Value& node, std::size_t count) {
  const auto index = node.integer();
  if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= count) return;
  bones.emplace_back(name_or_empty.string().value_or(name), static_cast<int>(*index));
}

}  // namespace

std::vector<std::pair<std::string, int>> read_humanoid(const File& file) {
  std::vector<std::pair<std::string, int>> bones;
  const std::size_t count = file.root()["nodes"].size();
  const json::Value extensions = file.root()["extensions"];
  for (const char* extension : {"VRMC_vrm", "VRM", "VRMC_vrm_animation"}) {
    const json::Value table = extensions[extension]["humanoid"]["humanBones"];
    for (const auto& [name, bone] : table.members()) add_bone(bones, {}, name, bone["node"], count);
    for (const json::Value& bone : table.items())
      if (bone["bone"].is_string()) add_bone(bones, bone["bone"], "", bone["node"], count);
    if (!bones.empty()) break;
  }
  return bones;
}

std::vector<int> joints_above(const Slim& slim, const std::vector<bool>& is_joint) {
  std::vector<int> above(slim.nodes.size(), -1);
  for (int index : slim.preorder) {
    const int parent = slim.node(index).parent;
    if (parent < 0) continue;
    const auto p = static_cast<std::size_t>(parent);
    above[static_cast<std::size_t>(index)] = is_joint[p] ? parent : above[p];
  }
  return above;
}

std::vector<Bones> find_bones(const Slim& slim,
                              const std::vector<std::pair<std::string, int>>& humanoid) {
  std::vector<bool> is_joint(slim.nodes.size(), false);
  Groups groups(slim.nodes.size());
  const auto add = [&](int joint, int first) {
    is_joint[static_cast<std::size_t>(joint)] = true;
    groups.unite(joint, first);
  };
  for (const SlimSkin& skin : slim.skins)
    for (int joint : skin.joints) add(joint, skin.joints[0]);
  for (const auto& [name, node] : humanoid) add(node, humanoid[0].second);
  const std::vector<int> above = joints_above(slim, is_joint);
  std::map<int, std::vector<int>> joints, skins;  // by leader
  for (int index : slim.preorder)
    if (is_joint[static_cast<std::size_t>(index)] && above[static_cast<std::size_t>(index)] >= 0)
      groups.unite(index, above[static_cast<std::size_t>(index)]);
  for (int index : slim.preorder)
    if (is_joint[static_cast<std::size_t>(index)]) joints[groups.leader(index)].push_back(index);

  Collector collector(slim, is_joint, above);
  std::vector<std::pair<std::size_t, int>> order;  // topmost joint and skin
  for (std::size_t k = 0; k < slim.skins.size(); ++k) {
    std::size_t first = slim.nodes.size();
    for (int joint : slim.skins[k].joints) first = std::min(first, collector.rank(joint));
    order.emplace_back(first, static_cast<int>(k));
  }
  std::sort(order.begin(), order.end());
  for (const auto& [rank, skin] : order)
    skins[groups.leader(slim.skins[static_cast<std::size_t>(skin)].joints[0])].push_back(skin);
  std::vector<Bones> result;
  for (const auto& [leader, list] : joints) {
    result.push_back(collector.collect(list));
    result.back().skins = skins[leader];
  }
  return result;
}

}  // namespace rigc::gltf
