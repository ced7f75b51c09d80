// SPDX-License-Identifier: MIT
// Which nodes a bake follows and how their transforms come about.
#include "bake/bodies.h"

#include <doctest/doctest.h>

#include "bake_helpers.h"

using namespace rigc;
using namespace rigc::bake;
using namespace rigc::bake::test;
using scene::Kind;
using scene::NodeId;
using Source = Body::Source;

namespace {

std::vector<Body> bodies_of(const Stage& stage, const Options& options,
                            std::vector<NodeId> animated = {}) {
  std::vector<bool> flags(stage.scene.size(), false);
  for (const NodeId id : animated) flags[id.index] = true;
  return find_bodies(stage.scene, stage.nodes(), flags, options);
}

const Body* body_of(const std::vector<Body>& bodies, NodeId id) {
  for (const Body& body : bodies)
    if (body.id == id) return &body;
  return nullptr;
}

}  // namespace

TEST_CASE("bake bodies: bases come first, free joints that nothing hangs under are left out") {
  Stage stage;
  const NodeId root = stage.joint("root", {}, {});
  const NodeId side = stage.joint("side", root, {});
  const NodeId driven = stage.joint("driven", root, {});
  stage.control_for(driven);
  const auto bodies = bodies_of(stage, {});
  REQUIRE(bodies.size() == 2);
  CHECK(bodies[0].id == root);
  CHECK_FALSE(bodies[0].is_output);
  CHECK(bodies[0].source == Source::local);
  CHECK(bodies[1].id == driven);
  CHECK(bodies[1].is_output);
  CHECK(bodies[1].base == 0);
  CHECK(body_of(bodies, side) == nullptr);
}

TEST_CASE("bake bodies: bases come first also where they were made last") {
  Stage stage;
  const NodeId child = stage.joint("child", {}, {});
  stage.control_for(child);
  const NodeId parent = stage.joint("parent", {}, {});
  stage.edit.reparent(child, parent);
  const auto bodies = bodies_of(stage, {});
  REQUIRE(bodies.size() == 2);
  CHECK(bodies[0].id == parent);
  CHECK(bodies[1].base == 0);
}

TEST_CASE("bake bodies: joints that commands made are bones below bones, not among controls") {
  Stage stage;
  const NodeId bone = stage.joint("bone", {}, {});
  const NodeId twist = stage.made(Kind::joint, "twist", bone);
  stage.control_for(twist);
  const NodeId space = stage.made(Kind::transform, "space");
  const NodeId helper = stage.made(Kind::joint, "helper", space);
  stage.control_for(helper);
  const auto bodies = bodies_of(stage, {});
  REQUIRE(body_of(bodies, twist));
  CHECK(body_of(bodies, twist)->is_output);
  CHECK(body_of(bodies, helper) == nullptr);
}

TEST_CASE("bake bodies: a driven joint makes up for a base that stands elsewhere") {
  Stage stage;
  const NodeId root = stage.joint("root", {}, {});
  const NodeId driven = stage.joint("driven", root, {});
  const NodeId below = stage.joint("below", driven, {});
  stage.control_for(driven);
  stage.control_for(below);
  Options options;
  options.standings = as_scene(stage);
  options.standings[root.index].local.translation = {1, 0, 0};
  const auto bodies = bodies_of(stage, options);
  CHECK(body_of(bodies, root)->source == Source::standing);
  CHECK(body_of(bodies, driven)->source == Source::world);
  CHECK(body_of(bodies, below)->source == Source::local);
}

TEST_CASE("bake bodies: rounding to floats is not standing elsewhere") {
  Stage stage;
  const NodeId root =
      stage.joint("root", {}, {{1.0 / 3, 0, 0}, math::axis_angle({0, 0, 1}, 0.3), {1, 1, 1}});
  const NodeId driven = stage.joint("driven", root, {});
  stage.control_for(driven);
  Options options;
  options.standings = as_scene(stage);
  math::Trs& local = options.standings[root.index].local;
  local.translation.x = static_cast<double>(static_cast<float>(local.translation.x));
  local.rotation.w = static_cast<double>(static_cast<float>(local.rotation.w));
  const auto bodies = bodies_of(stage, options);
  CHECK(body_of(bodies, root)->source == Source::local);
  CHECK(body_of(bodies, driven)->source == Source::local);
}

TEST_CASE("bake bodies: a lost joint has no channels") {
  Stage stage;
  const NodeId driven = stage.joint("driven", {}, {});
  stage.control_for(driven);
  std::vector<int> nodes = stage.nodes();
  nodes[driven.index] = -1;
  CHECK(find_bodies(stage.scene, nodes, std::vector<bool>(stage.scene.size()), {}).empty());
}
