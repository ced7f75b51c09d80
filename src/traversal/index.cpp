// SPDX-License-Identifier: MIT
// The index over a scene: lists by group, label and joint. Nodes leave in the reverse order in
// which they came (a journal is undone backwards), so removal looks at the end of a list first.
// Test: tests/traversal/index_test.cpp
#include "traversal/index.h"

#include <algorithm>
#include <cassert>

namespace rigc::traversal {
namespace {

const std::vector<NodeId> kNone;

std::string key_of(std::string_view global, std::string_view local, std::string_view label = {}) {
  std::string key;
  key.reserve(global.size() + local.size() + label.size() + 2);
  return key.append(global).append(1, '\0').append(local).append(1, '\0').append(label);
}

template <class Map, class Key>
const std::vector<NodeId>& look_up(const Map& lists, const Key& key) {
  auto found = lists.find(key);
  return found == lists.end() ? kNone : found->second;
}

template <class Map, class Key>
void remove_from(Map& lists, const Key& key, NodeId node) {
  auto found = lists.find(key);
  assert(found != lists.end());
  auto& list = found->second;
  auto place = std::find(list.rbegin(), list.rend(), node);
  assert(place != list.rend());
  list.erase(std::next(place).base());
  if (list.empty()) lists.erase(found);
}

}  // namespace

void Index::added(const scene::Scene& scene, NodeId id) {
  const scene::Node& node = scene[id];
  const auto& [global, local, label] = node.ids;
  if (node.is_skeleton()) joints_[key_of(global, local)].push_back(id);
  groups_[key_of(global, local)].push_back(id);
  if (!label.empty()) labels_[key_of(global, local, label)].push_back(id);
  ++names_[global][local][label];
  if (node.is_skeleton()) {
    skeleton_[node.identity.owner] = id;
  } else {
    made_[node.identity.owner].push_back(id);
    modules_[key_of(global, node.module)].push_back(id);
  }
}

void Index::removing(const scene::Scene& scene, NodeId id) {
  const scene::Node& node = scene[id];
  const auto& [global, local, label] = node.ids;
  if (node.is_skeleton()) remove_from(joints_, key_of(global, local), id);
  remove_from(groups_, key_of(global, local), id);
  if (!label.empty()) remove_from(labels_, key_of(global, local, label), id);
  auto& in_global = names_[global];
  auto& in_local = in_global[local];
  if (--in_local[label] == 0) in_local.erase(label);
  if (in_local.empty()) in_global.erase(local);
  if (in_global.empty()) names_.erase(global);
  if (node.is_skeleton()) {
    skeleton_.erase(node.identity.owner);
  } else {
    remove_from(made_, node.identity.owner, id);
    remove_from(modules_, key_of(global, node.module), id);
  }
}

const std::vector<NodeId>& Index::joints(std::string_view global, std::string_view local) const {
  return look_up(joints_, key_of(global, local));
}

const std::vector<NodeId>& Index::group(std::string_view global, std::string_view local) const {
  return look_up(groups_, key_of(global, local));
}

const std::vector<NodeId>& Index::labelled(std::string_view global, std::string_view local,
                                           std::string_view label) const {
  return look_up(labels_, key_of(global, local, label));
}

const std::vector<NodeId>& Index::made_for(const JointKey& owner) const {
  return look_up(made_, owner);
}

const std::vector<NodeId>& Index::made_by(std::string_view global, std::string_view module) const {
  return look_up(modules_, key_of(global, module));
}

NodeId Index::joint(const JointKey& key) const {
  auto found = skeleton_.find(key);
  return found == skeleton_.end() ? NodeId{} : found->second;
}

bool Index::has_global(std::string_view global) const {
  return names_.count(std::string(global)) != 0;
}

std::vector<std::string> Index::groups(std::string_view global) const {
  std::vector<std::string> names;
  auto found = names_.find(std::string(global));
  if (found == names_.end()) return names;
  for (const auto& [local, labels] : found->second) {
    if (!local.empty()) names.push_back(local);
  }
  return names;
}

std::vector<std::string> Index::labels(std::string_view global, std::string_view local) const {
  std::vector<std::string> names;
  auto found = names_.find(std::string(global));
  if (found == names_.end()) return names;
  auto group = found->second.find(std::string(local));
  if (group == found->second.end()) return names;
  for (const auto& [label, count] : group->second) {
    if (!label.empty()) names.push_back(label);
  }
  return names;
}

}  // namespace rigc::traversal
