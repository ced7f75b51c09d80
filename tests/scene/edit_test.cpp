// SPDX-License-Identifier: MIT
// Law 2 at the scene: whatever was changed, undo gives the identical scene, one command at a time.
#include "scene/edit.h"

#include <doctest/doctest.h>

#include <set>

#include "tests/scene/random_edits.h"

namespace rigc {
namespace {

using scene::Edit;
using scene::Journal;
using scene::Kind;
using scene::Node;
using scene::NodeId;
using scene::Scene;
namespace transform = scene::transform;

// Keeps a set of nodes, as an index does.
class Watcher : public scene::Observer {
 public:
  void added(const Scene& scene, NodeId node) override {
    CHECK(node.index == scene.size() - 1);
    CHECK(nodes.insert(node).second);
  }
  void removing(const Scene& scene, NodeId node) override {
    CHECK(node.index < scene.size());  // still there to be looked at
    CHECK(nodes.erase(node) == 1);
  }
  std::set<NodeId> nodes;
};

bool consistent(const Scene& scene) {
  for (const NodeId id : scene.nodes()) {
    for (const NodeId child : scene[id].children) {
      if (scene[child].parent != id) return false;
    }
    const NodeId parent = scene[id].parent;
    if (!parent.valid()) continue;
    const auto& siblings = scene[parent].children;
    if (std::count(siblings.begin(), siblings.end(), id) != 1) return false;
  }
  return true;
}

TEST_CASE("scene edit: undoing commands one by one passes the same scenes backwards") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Scene scene;
    Watcher watcher;
    test::RandomEdits edits(scene, seed);
    std::vector<Journal> journals;
    std::vector<std::string> dumps;
    for (std::uint32_t command = 0; command < 12; ++command) {
      dumps.push_back(scene.dump());
      journals.emplace_back();
      edits.run(journals.back(), &watcher, 1 + static_cast<int>(seed % 20), command);
      REQUIRE(consistent(scene));
      REQUIRE(watcher.nodes.size() == scene.size());
    }
    CHECK(scene.dump() != dumps.front());
    while (!journals.empty()) {
      Edit::undo(scene, journals.back(), &watcher);
      CHECK(journals.back().empty());
      REQUIRE(scene.dump() == dumps.back());
      REQUIRE(consistent(scene));
      REQUIRE(watcher.nodes.size() == scene.size());
      journals.pop_back();
      dumps.pop_back();
    }
    CHECK(scene.size() == 0);
  }
}

TEST_CASE("scene edit: the same commands again after undo give the same scene") {
  for (std::uint64_t seed = 100; seed <= 130; ++seed) {
    Scene scene;
    Journal first, second;
    test::RandomEdits(scene, seed).run(first, nullptr, 60, 0);
    const std::string before = scene.dump();
    test::RandomEdits(scene, seed + 1).run(second, nullptr, 60, 1);
    const std::string after = scene.dump();
    Edit::undo(scene, second, nullptr);
    CHECK(scene.dump() == before);
    test::RandomEdits(scene, seed + 1).run(second, nullptr, 60, 1);
    CHECK(scene.dump() == after);
  }
}

NodeId make(Edit& edit, NodeId parent = {}) {
  Node node;
  node.parent = parent;
  return edit.make(std::move(node));
}

TEST_CASE("scene edit: reparenting keeps and restores the order of children") {
  Scene scene;
  Journal built, moved;
  Edit build(scene, built, nullptr);
  const NodeId root = make(build), a = make(build, root), b = make(build, root),
               c = make(build, root);
  Edit edit(scene, moved, nullptr);
  edit.reparent(b, c);
  edit.reparent(a, c);
  CHECK(scene[root].children == std::vector<NodeId>{c});
  CHECK(scene[c].children == std::vector<NodeId>{b, a});
  edit.reparent(b, {});
  CHECK(!scene[b].parent.valid());
  Edit::undo(scene, moved, nullptr);
  CHECK(scene[root].children == std::vector<NodeId>{a, b, c});
  CHECK(scene[c].children.empty());
}

TEST_CASE("scene edit: reparenting to the same parent changes nothing") {
  Scene scene;
  Journal built, moved;
  Edit build(scene, built, nullptr);
  const NodeId root = make(build), a = make(build, root);
  make(build, root);
  Edit(scene, moved, nullptr).reparent(a, root);
  CHECK(moved.empty());
  CHECK(scene[root].children.front() == a);
}

TEST_CASE("scene edit: a connection replaces the one before and undo brings it back") {
  Scene scene;
  Journal built, changed;
  Edit build(scene, built, nullptr);
  const NodeId a = make(build), b = make(build), to = make(build);
  build.connect({a, transform::kScale}, {to, transform::kScale});
  Edit edit(scene, changed, nullptr);
  edit.connect({b, transform::kScale}, {to, transform::kScale});
  CHECK(scene.source({to, transform::kScale})->node == b);
  CHECK(scene[to].inputs.size() == 1);
  edit.disconnect({to, transform::kScale});
  CHECK(scene[to].inputs.empty());
  edit.disconnect({to, transform::kScale});
  Edit::undo(scene, changed, nullptr);
  CHECK(scene.source({to, transform::kScale})->node == a);
}

TEST_CASE("scene edit: connecting past the end of an array appends an element") {
  Scene scene;
  Journal built, changed;
  Edit build(scene, built, nullptr);
  const NodeId a = make(build);
  Node node;
  node.kind = Kind::point_constraint;
  const NodeId point = build.make(std::move(node));
  Edit edit(scene, changed, nullptr);
  const scene::Plug first{point, scene::constraint::kTargets, 0};
  edit.connect({a, transform::kWorld}, first);
  CHECK(scene[point].attributes[scene::constraint::kTargets].size() == 1);
  CHECK(scene.source(first)->node == a);
  Edit::undo(scene, changed, nullptr);
  CHECK(scene[point].attributes[scene::constraint::kTargets].empty());
  CHECK(scene[point].inputs.empty());
}

TEST_CASE("scene edit: the value under a connection stays") {
  Scene scene;
  Journal journal;
  Edit edit(scene, journal, nullptr);
  const NodeId a = make(edit), b = make(edit);
  edit.set({b, transform::kScale}, math::Vec3{2, 3, 4});
  edit.connect({a, transform::kScale}, {b, transform::kScale});
  CHECK(std::get<math::Vec3>(scene.value({b, transform::kScale})) == math::Vec3{2, 3, 4});
}

}  // namespace
}  // namespace rigc
