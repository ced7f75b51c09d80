// SPDX-License-Identifier: MIT
// Reading a scene: values, plugs by name, types, connections, rest transforms.
#include "scene/scene.h"

#include <doctest/doctest.h>

#include "scene/edit.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Vec3;
using scene::Edit;
using scene::Journal;
using scene::Kind;
using scene::Node;
using scene::NodeId;
using scene::Plug;
using scene::Scene;
using scene::Type;
namespace transform = scene::transform;
namespace constraint = scene::constraint;

struct Built {
  Scene scene;
  Journal journal;
  Edit edit{scene, journal, nullptr};

  NodeId make(Kind kind, NodeId parent = {}) {
    Node node;
    node.kind = kind;
    node.parent = parent;
    return edit.make(std::move(node));
  }
};

TEST_CASE("scene: a new node has its kind's values") {
  Built b;
  const NodeId joint = b.make(Kind::joint);
  const NodeId remap = b.make(Kind::remap);
  CHECK(std::get<Vec3>(b.scene.value({joint, transform::kScale})) == Vec3{1, 1, 1});
  CHECK(std::get<math::Quat>(b.scene.value({joint, transform::kRotation})) == math::Quat{});
  CHECK(b.scene.number({joint, transform::kVisible}) == 1);
  CHECK(b.scene.number({remap, scene::remap::kInputMax}) == 1);
  const NodeId aim = b.make(Kind::aim_constraint);
  CHECK(b.scene[aim].attributes[scene::aim::kTargets].empty());
  CHECK(std::get<math::Affine>(b.scene.value({aim, scene::aim::kUpTarget})) == math::Affine{});
}

TEST_CASE("scene: values by component and element") {
  Built b;
  const NodeId node = b.make(Kind::control);
  b.edit.set({node, transform::kTranslate}, Vec3{1, 2, 3});
  b.edit.set({node, transform::kTranslate, -1, 1}, 5.0);
  CHECK(b.scene.number({node, transform::kTranslate, -1, 1}) == 5);
  CHECK(std::get<Vec3>(b.scene.value({node, transform::kTranslate})) == Vec3{1, 5, 3});
  b.edit.set({node, transform::kRotation, -1, 3}, 0.5);
  CHECK(std::get<math::Quat>(b.scene.value({node, transform::kRotation})).w == 0.5);

  const NodeId point = b.make(Kind::point_constraint);
  b.edit.set({point, constraint::kWeights, 0}, 0.25);
  b.edit.set({point, constraint::kWeights, 1}, 0.75);
  b.edit.set({point, constraint::kWeights, 0}, 0.5);
  CHECK(b.scene[point].attributes[constraint::kWeights].size() == 2);
  CHECK(b.scene.number({point, constraint::kWeights, 0}) == 0.5);
}

TEST_CASE("scene: types of plugs, and plugs that are none") {
  Built b;
  const NodeId node = b.make(Kind::control);
  const NodeId point = b.make(Kind::point_constraint);
  const NodeId chain = b.make(Kind::ik_chain);
  CHECK(b.scene.type({node, transform::kTranslate}) == Type::vec3);
  CHECK(b.scene.type({node, transform::kTranslate, -1, 2}) == Type::number);
  CHECK(b.scene.type({node, transform::kRotation, -1, 3}) == Type::number);
  CHECK(b.scene.type({node, transform::kWorld}) == Type::matrix);
  CHECK(!b.scene.type({node, transform::kTranslate, -1, 3}));
  CHECK(!b.scene.type({node, transform::kTranslate, 0}));
  CHECK(!b.scene.type({node, transform::kVisible, -1, 0}));
  CHECK(!b.scene.type({node, transform::kWorld, -1, 0}));
  CHECK(!b.scene.type({node, 999}));
  CHECK(!b.scene.type({node, scene::kUserAttributes}));
  CHECK(!b.scene.type({NodeId{}, 0}));
  CHECK(!b.scene.type({point, constraint::kTargets}));
  CHECK(b.scene.type({point, constraint::kTargets, 0}) == Type::matrix);
  CHECK(!b.scene.type({point, constraint::kTargets, 1}));
  CHECK(b.scene.type({chain, scene::ik_chain::kRotations, 7}) == Type::quat);
}

TEST_CASE("scene: plugs by name and back") {
  Built b;
  const NodeId node = b.make(Kind::control);
  const NodeId point = b.make(Kind::point_constraint);
  b.edit.set({point, constraint::kWeights, 0}, 1.0);
  scene::UserAttribute stretch;
  stretch.name = "stretch";
  const Plug user = b.edit.add_attribute(node, stretch);
  CHECK(b.scene.find_plug(node, "stretch") == user);
  CHECK(b.scene.find_plug(node, "translate") == Plug{node, transform::kTranslate});
  CHECK(b.scene.find_plug(node, "translate", "y") == Plug{node, transform::kTranslate, -1, 1});
  CHECK(b.scene.find_plug(node, "rotation", "w") == Plug{node, transform::kRotation, -1, 3});
  CHECK(b.scene.find_plug(point, "weights[0]") == Plug{point, constraint::kWeights, 0});
  for (const char* name : {"weight", "weights", "weights[2]", "weights[-1]", "weights[",
                           "weights[0", "weights[x]", ""}) {
    CAPTURE(name);
    CHECK(!b.scene.find_plug(point, name));
  }
  CHECK(!b.scene.find_plug(node, "translate", "w"));
  CHECK(!b.scene.find_plug(node, "translate", "xy"));
  CHECK(!b.scene.find_plug(node, "stretch", "x"));
  CHECK(b.scene.plug_name({point, constraint::kWeights, 0}) == "weights[0]");
  CHECK(b.scene.plug_name({node, transform::kTranslate, -1, 2}) == "translate.z");
  CHECK(b.scene.plug_name(user) == "stretch");
  for (const NodeId id : b.scene.nodes()) {
    for (const std::string& name : b.scene.plug_names(id)) {
      const auto plug = b.scene.find_plug(id, name);
      REQUIRE(plug);
      CHECK(b.scene.plug_name(*plug) == name);
    }
  }
}

TEST_CASE("scene: what a program gives is found by its name") {
  Built b;
  const NodeId node = b.make(Kind::compute);
  b.edit.set({node, scene::compute::kCode},
             std::string("in m: matrix; out bend = m.x.y; out way = m.origin; out side = m.z;"));
  CHECK(b.scene.find_plug(node, "bend") == Plug{node, scene::compute::kNumberOut, 0});
  CHECK(b.scene.find_plug(node, "side") == Plug{node, scene::compute::kVectorOut, 1});
  CHECK(b.scene.find_plug(node, "side", "y") == Plug{node, scene::compute::kVectorOut, 1, 1});
  CHECK_FALSE(b.scene.find_plug(node, "m"));
  CHECK_FALSE(b.scene.find_plug(node, "bend", "x"));
  const auto names = b.scene.plug_names(node);
  CHECK(names == std::vector<std::string>{"code", "bend", "way", "side"});
}

TEST_CASE("scene: roles") {
  Built b;
  const NodeId node = b.make(Kind::control);
  CHECK(b.scene.role({node, transform::kTranslate}) == scene::Role::input);
  CHECK(b.scene.role({node, transform::kWorld}) == scene::Role::output);
  CHECK(b.scene.role({node, scene::control::kShape}) == scene::Role::data);
  const Plug user = b.edit.add_attribute(node, {.name = "a", .min = {}, .max = {}});
  CHECK(b.scene.role(user) == scene::Role::input);
}

TEST_CASE("scene: connections are found by the exact plug and kept in order") {
  Built b;
  const NodeId from = b.make(Kind::control), to = b.make(Kind::joint);
  b.edit.connect({from, transform::kTranslate, -1, 0}, {to, transform::kTranslate, -1, 2});
  b.edit.connect({from, transform::kScale}, {to, transform::kScale});
  b.edit.connect({from, transform::kTranslate, -1, 1}, {to, transform::kTranslate, -1, 0});
  const auto& inputs = b.scene[to].inputs;
  REQUIRE(inputs.size() == 3);
  CHECK(std::is_sorted(inputs.begin(), inputs.end()));
  CHECK(b.scene.source({to, transform::kScale}) == Plug{from, transform::kScale});
  CHECK(b.scene.source({to, transform::kTranslate, -1, 2}) ==
        Plug{from, transform::kTranslate, -1, 0});
  CHECK(!b.scene.source({to, transform::kTranslate}));
  CHECK(!b.scene.source({to, transform::kTranslate, -1, 1}));
}

TEST_CASE("scene: the Euler view shows the rotation and sets it") {
  Built b;
  const NodeId node = b.make(Kind::control);
  b.edit.set({node, transform::kRotate}, Vec3{0, 0, 90});
  const auto q = std::get<math::Quat>(b.scene.value({node, transform::kRotation}));
  CHECK(test::distance(q, math::axis_angle({0, 0, 1}, math::kPi / 2)) < 1e-15);
  b.edit.set({node, transform::kRotation}, math::axis_angle({1, 0, 0}, math::kPi / 6));
  CHECK(b.scene.number({node, transform::kRotate, -1, 0}) == doctest::Approx(30));
  b.edit.set({node, transform::kRotate, -1, 1}, 20.0);
  CHECK(b.scene.number({node, transform::kRotate, -1, 0}) == doctest::Approx(30));
  CHECK(b.scene.number({node, transform::kRotate, -1, 1}) == doctest::Approx(20));
}

TEST_CASE("scene: setting the angles that a rotation has changes no bit of it") {
  test::Random random(1);
  Built b;
  const NodeId node = b.make(Kind::control);
  for (int i = 0; i < 100; ++i) {
    const math::Quat q = random.rotation();
    b.edit.set({node, transform::kRotation}, q);
    b.edit.set({node, transform::kRotate}, b.scene.value({node, transform::kRotate}));
    CHECK(std::get<math::Quat>(b.scene.value({node, transform::kRotation})) == q);
  }
}

TEST_CASE("scene: the rest world is the product of the locals above") {
  test::Random random(2);
  Built b;
  NodeId parent;
  math::Affine world;
  for (int i = 0; i < 20; ++i) {
    parent = b.make(i % 2 ? Kind::joint : Kind::transform, parent);
    const math::Trs trs = random.trs();
    b.edit.set({parent, transform::kTranslate}, trs.translation);
    b.edit.set({parent, transform::kRotation}, trs.rotation);
    b.edit.set({parent, transform::kScale}, trs.scale);
    world = world * math::compose(trs);
    CHECK(test::distance(b.scene.rest_world(parent), world) <
          1e-14 * math::length(world.linear.x) + 1e-14 * math::length(world.origin));
  }
}

TEST_CASE("scene: a chain of a hundred thousand has a rest world") {
  Built b;
  NodeId parent;
  for (int i = 0; i < 100000; ++i) {
    parent = b.make(Kind::joint, parent);
    b.edit.set({parent, transform::kTranslate}, Vec3{0, 0.5, 0});
  }
  CHECK(b.scene.rest_world(parent).origin == Vec3{0, 50000, 0});
}

}  // namespace
}  // namespace rigc
