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

/// Lowest common ancestors in logarithmic time. Jump pointers: Myers 1983, "An applicative
/// random-access stack".
class Ancestry {
 public:
  explicit Ancestry(const Slim& slim) : nodes_(slim.nodes.size()) {
    for (std::size_t i = 0; i < slim.preorder.size(); ++i) {
      const int index = slim.preorder[i];
      const int parent = slim.node(index).parent;
      Entry& entry = at(index);
      entry.rank = entry.last = i;
      entry.parent = entry.jump = parent;
      if (parent < 0) continue;
      entry.depth = at(parent).depth + 1;
      const int jump = at(parent).jump;
      const int further = jump < 0 ? -1 : at(jump).jump;
      if (depth(parent) - depth(jump) == depth(jump) - depth(further)) entry.jump = further;
    }
    for (std::size_t i = slim.preorder.size(); i-- > 0;)
      if (const Entry& entry = at(slim.preorder[i]); entry.parent >= 0)
        at(entry.parent).last = std::max(at(entry.parent).last, entry.last);
  }

  /// Place of a node in preorder.
  std::size_t rank(int node) const { return at(node).rank; }

  /// The lowest node that is above all of `nodes` and not one of them; -1: none.
  int common(const std::vector<int>& nodes) const {
    std::size_t first = nodes_.size(), last = 0;
    for (int node : nodes) {
      first = std::min(first, rank(node));
      last = std::max(last, rank(node));
    }
    const auto above_all = [&](int node) {
      return node < 0 || (at(node).rank < first && at(node).last >= last);
    };
    int node = nodes[0];
    while (!above_all(node)) node = above_all(at(node).jump) ? at(node).parent : at(node).jump;
    return node;
  }

 private:
  struct Entry {
    std::size_t rank = 0, last = 0;  ///< in preorder: the node, and the last one under it
    int parent = -1, jump = -1;
    int depth = 1;
  };
  int depth(int node) const { return node < 0 ? 0 : at(node).depth; }
  const Entry& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  Entry& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
  std::vector<Entry> nodes_;
};

/// Collects the nodes of one skeleton after the other. Each node is claimed once, so that all of
/// them together cost no more than the file has nodes.
class Collector {
 public:
  Collector(const Slim& slim, const std::vector<bool>& is_joint, const std::vector<int>& above,
            const Ancestry& ancestry)
      : slim_(slim), is_joint_(is_joint), above_(above), ancestry_(ancestry) {
    claimed_.resize(slim.nodes.size(), false);
  }

  Bones collect(const std::vector<int>& joints) {
    Bones bones;
    std::vector<int> tops;
    for (int joint : joints)
      if (above_[static_cast<std::size_t>(joint)] < 0) tops.push_back(joint);
    bones.ancestor = ancestry_.common(tops);
    for (int joint : joints) {
      int node = joint;
      while (node != bones.ancestor && claim(node, bones)) node = slim_.node(node).parent;
    }
    for (int joint : joints) claim_below(joint, bones);
    std::sort(bones.nodes.begin(), bones.nodes.end(),
              [&](int a, int b) { return ancestry_.rank(a) < ancestry_.rank(b); });
    return bones;
  }

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

  const Slim& slim_;
  const std::vector<bool>& is_joint_;
  const std::vector<int>& above_;
  const Ancestry& ancestry_;
  std::vector<bool> claimed_;
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

  const Ancestry ancestry(slim);
  Collector collector(slim, is_joint, above, ancestry);
  std::vector<std::pair<std::size_t, int>> order;  // topmost joint and skin
  for (std::size_t k = 0; k < slim.skins.size(); ++k) {
    std::size_t first = slim.nodes.size();
    for (int joint : slim.skins[k].joints) first = std::min(first, ancestry.rank(joint));
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
