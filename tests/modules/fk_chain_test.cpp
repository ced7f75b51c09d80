// SPDX-License-Identifier: MIT
// fk_chain: each control turns its joint and all after it.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

test::Commands chain(const std::string& more = {}) {
  return {{"base", "{command: control, with: {}}"},
          {"tail", "{command: fk_chain, with: {joints: \"tail[*]\"" + more + "}}"}};
}

std::string fk(int i) { return "tail[" + std::to_string(i) + "]/fk_chain"; }

}  // namespace

TEST_CASE("modules fk_chain: a control for each joint, each under the one before") {
  const test::Rig rig(test::tail(4, chain()));
  REQUIRE(rig.clean());
  REQUIRE(rig.nodes("tail/fk_chain").size() == 4);
  CHECK(rig.scene()[rig.node(fk(0) + ".zero")].parent == rig.node("base/control"));
  for (int i = 1; i < 4; ++i) {
    CHECK(rig.scene()[rig.node(fk(i) + ".zero")].parent == rig.node(fk(i - 1)));
  }
}

TEST_CASE("modules fk_chain: a chain may grow, the controls stay the same kind") {
  for (const int count : {1, 2, 9}) {
    const test::Rig rig(test::tail(count, chain()));
    REQUIRE(rig.clean());
    CHECK(rig.nodes("tail/fk_chain").size() == static_cast<std::size_t>(count));
    CHECK(test::rest_error(rig) < 1e-12);
  }
}

TEST_CASE("modules fk_chain: turning one control turns all after it and stretches nothing") {
  const test::Rig rig(test::tail(5, chain()));
  test::Pose pose(rig);
  pose.turn_in_world(fk(2), math::from_euler_degrees({0, 90, 0}));
  const auto joints = pose.joints();
  CHECK(test::distance(joints[3].origin, {0, 1, -0.5}) < 1e-12);  // the joint itself stays
  CHECK(test::distance(joints[5].origin, {-0.5, 1, -0.5}) < 1e-12);
  CHECK(test::largest_difference(test::bone_lengths(rig, joints),
                                 test::bone_lengths(rig, test::Pose(rig).joints())) < 1e-12);
}

TEST_CASE("modules fk_chain: the same turns are the same motion on every model") {
  const auto curl = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    for (int i = 0; i < 4; ++i) {
      pose.turn_in_world(fk(i), test::mapped(by, math::from_euler_degrees({10.0 * i, 15, -5})));
    }
    return test::motion(rig, pose);
  };
  const test::Rig plain(test::tail(4, chain()));
  const auto expected = curl(plain, {});
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::tail(4, chain()), model.change);
    CHECK(test::motion_difference(rig, curl(rig, model.by), test::mapped(model.by, expected)) <
          1e-9);
  }
}

TEST_CASE("modules fk_chain: without the last joint it has no control") {
  const test::Rig rig(test::tail(4, chain(", last: off")));
  REQUIRE(rig.clean());
  CHECK(rig.nodes("tail/fk_chain").size() == 3);
  CHECK(rig.nodes("tail[END]/fk_chain").empty());
}

TEST_CASE("modules fk_chain: translate lets a joint leave its place") {
  const test::Rig rig(test::tail(3, chain(", translate: on, orient: world")));
  test::Pose pose(rig);
  pose.translate(fk(1), {0, 0.3, 0});
  CHECK(test::distance(pose.position("tail[1]"), {0, 1.3, -0.5}) < 1e-12);
  CHECK(test::distance(pose.position("tail[2]"), {0, 1.3, -1}) < 1e-12);
}

TEST_CASE("modules fk_chain: joints that are named from last to first are refused") {
  const test::Rig rig(test::tail(
      4,
      {{"tail", "{command: fk_chain, with: {joints: [\"tail[0]\", \"tail[2]\", \"tail[1]\"]}}"}}));
  CHECK(test::codes(rig.diagnostics) == "RIG0460");
}

TEST_CASE("modules fk_chain: hinges bend the chain in its plane about one axis") {
  const char* command =
      "{command: fk_chain, with: {joints: [limb.upper, limb.lower, limb.end], orient: hinge}}";
  for (const char* middle : {"[0.1, 0.5, 0.1]", "[-0.02, 0.52, 0.1]", "[0.07, 0.5, -0.05]"}) {
    CAPTURE(middle);
    const test::Rig rig(test::limb("[0, 1, 0]", middle, "[0.03, 0.1, 0.02]", {{"upper", command}}));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose pose(rig);
    const math::Vec3 start = pose.position("limb.upper"), end = pose.position("limb.end");
    const math::Vec3 normal =
        math::normalised(math::cross(pose.position("limb.lower") - start, end - start));
    pose.set("limb.lower/fk_chain@rotate", math::Vec3{0, 0, 50});
    CHECK(test::distance(pose.position("limb.end"), end) > 0.1);
    CHECK(std::abs(math::dot(pose.position("limb.end") - start, normal)) < 1e-9);
  }
}
