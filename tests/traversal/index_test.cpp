// SPDX-License-Identifier: MIT
// The index answers exactly what a scan of the scene would, whatever came and went.
#include "traversal/index.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support/skeletons.h"

using namespace rigc;
using scene::Kind;
using scene::NodeId;
using traversal::Index;

namespace {

constexpr const char* kGroups[] = {"", "arm_l", "arm_r", "spine"};
constexpr const char* kLabels[] = {"", "elbow", "wrist"};
constexpr const char* kModules[] = {"control", "fk_chain", "joint"};

scene::Node joint_node(std::uint64_t uid, const char* local, const char* label) {
  scene::Node node;
  node.kind = Kind::joint;
  node.ids = {"hero", local, label};
  node.identity.owner = {uid, 0};
  return node;
}

scene::Node made_node(Kind kind, std::uint64_t owner, const char* local, const char* label,
                      const char* module) {
  scene::Node node;
  node.kind = kind;
  node.ids = {"hero", local, label};
  node.identity.owner = {owner, 0};
  node.identity.role = "control";
  node.module = module;
  node.command = 0;
  return node;
}

/// A scene with its index and one journal for each batch of changes.
struct Watched {
  scene::Scene scene;
  Index index;
  std::vector<scene::Journal> journals;

  void begin() { journals.emplace_back(); }
  NodeId make(scene::Node node) {
    scene::Edit edit(scene, journals.back(), &index);
    return edit.make(std::move(node));
  }
  void undo() {
    scene::Edit::undo(scene, journals.back(), &index);
    journals.pop_back();
  }
};

template <class Wanted>
std::vector<NodeId> scan(const scene::Scene& scene, Wanted wanted) {
  std::vector<NodeId> found;
  for (NodeId id : scene.nodes()) {
    if (wanted(scene[id])) found.push_back(id);
  }
  return found;
}

void check_group(const Watched& w, const std::string& local) {
  const auto in_group = [&](const scene::Node& n) { return n.ids.local == local; };
  CHECK(w.index.group("hero", local) == scan(w.scene, in_group));
  CHECK(w.index.joints("hero", local) ==
        scan(w.scene, [&](const scene::Node& n) { return in_group(n) && n.is_skeleton(); }));
  std::set<std::string> labels;
  for (NodeId id : w.index.group("hero", local)) labels.insert(w.scene[id].ids.label);
  labels.erase("");
  CHECK(w.index.labels("hero", local) == std::vector<std::string>(labels.begin(), labels.end()));
  for (const std::string label : kLabels) {
    if (label.empty()) continue;
    CHECK(w.index.labelled("hero", local, label) ==
          scan(w.scene, [&](const scene::Node& n) { return in_group(n) && n.ids.label == label; }));
  }
}

void check_all(const Watched& w) {
  for (const char* local : kGroups) check_group(w, local);
  std::set<std::string> groups;
  std::set<std::uint64_t> owners;
  for (NodeId id : w.scene.nodes()) {
    groups.insert(w.scene[id].ids.local);
    owners.insert(w.scene[id].identity.owner.uid);
  }
  groups.erase("");
  CHECK(w.index.groups("hero") == std::vector<std::string>(groups.begin(), groups.end()));
  CHECK(w.index.has_global("hero") == (w.scene.size() > 0));
  for (const std::uint64_t uid : owners) {
    CHECK(w.index.made_for({uid, 0}) == scan(w.scene, [&](const scene::Node& n) {
            return !n.is_skeleton() && n.identity.owner.uid == uid;
          }));
  }
  for (const char* module : kModules) {
    CHECK(w.index.made_by("hero", module) ==
          scan(w.scene, [&](const scene::Node& n) { return n.module == module; }));
  }
}

}  // namespace

TEST_CASE("traversal index: an empty index answers with empty lists") {
  const Index index;
  CHECK(index.joints("hero", "arm_l").empty());
  CHECK(index.group("hero", "arm_l").empty());
  CHECK(index.labelled("hero", "arm_l", "elbow").empty());
  CHECK(index.made_for({1, 0}).empty());
  CHECK(index.made_by("hero", "control").empty());
  CHECK(index.groups("hero").empty());
  CHECK(index.labels("hero", "arm_l").empty());
  CHECK_FALSE(index.has_global("hero"));
  CHECK_FALSE(index.joint({1, 0}).valid());
}

TEST_CASE("traversal index: skeleton joints and made nodes are told apart") {
  Watched w;
  w.begin();
  const NodeId elbow = w.make(joint_node(1, "arm_l", "elbow"));
  const NodeId wrist = w.make(joint_node(2, "arm_l", "wrist"));
  w.begin();
  const NodeId control = w.make(made_node(Kind::control, 2, "arm_l", "wrist", "control"));
  const NodeId twist = w.make(made_node(Kind::joint, 2, "arm_l", "twist", "joint"));
  CHECK(w.index.joint({1, 0}) == elbow);
  CHECK(w.index.joint({2, 0}) == wrist);
  CHECK_FALSE(w.index.joint({2, 1}).valid());
  CHECK(w.index.joints("hero", "arm_l") == std::vector{elbow, wrist});
  CHECK(w.index.group("hero", "arm_l") == std::vector{elbow, wrist, control, twist});
  CHECK(w.index.labelled("hero", "arm_l", "wrist") == std::vector{wrist, control});
  CHECK(w.index.made_for({2, 0}) == std::vector{control, twist});
  CHECK(w.index.made_for({1, 0}).empty());
  CHECK(w.index.made_by("hero", "joint") == std::vector{twist});
  CHECK(w.index.labels("hero", "arm_l") == std::vector<std::string>{"elbow", "twist", "wrist"});
  CHECK(w.index.groups("other").empty());
  CHECK_FALSE(w.index.has_global("other"));

  w.undo();
  CHECK(w.index.group("hero", "arm_l") == std::vector{elbow, wrist});
  CHECK(w.index.labels("hero", "arm_l") == std::vector<std::string>{"elbow", "wrist"});
  CHECK(w.index.joint({2, 0}) == wrist);
  w.undo();
  CHECK_FALSE(w.index.has_global("hero"));
  CHECK_FALSE(w.index.joint({2, 0}).valid());
}

TEST_CASE("traversal index: names with the separator's look-alikes do not mix") {
  Watched w;
  w.begin();
  const NodeId one = w.make(joint_node(1, "a", "bc"));
  const NodeId two = w.make(joint_node(2, "ab", "c"));
  CHECK(w.index.labelled("hero", "a", "bc") == std::vector{one});
  CHECK(w.index.labelled("hero", "ab", "c") == std::vector{two});
  CHECK(w.index.labelled("hero", "abc", "").empty());
}

TEST_CASE(
    "traversal index: after random comings and goings every list equals a scan of the scene") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    Watched w;
    w.begin();
    for (std::uint64_t uid = 1; uid <= 6; ++uid) {
      w.make(joint_node(uid, kGroups[random.below(4)], kLabels[random.below(3)]));
    }
    for (int step = 0; step < 40; ++step) {
      if (w.journals.size() > 1 && random.chance(0.4)) {
        w.undo();
      } else {
        w.begin();
        for (std::size_t n = random.below(5); n > 0; --n) {
          const Kind kind = random.chance(0.3) ? Kind::joint : Kind::control;
          const std::uint64_t owner = 1 + random.below(6);
          const char* local = kGroups[random.below(4)];
          const char* label = kLabels[random.below(3)];
          w.make(made_node(kind, owner, local, label, kModules[random.below(3)]));
        }
      }
      check_all(w);
    }
    while (!w.journals.empty()) w.undo();
    check_all(w);
  }
}
