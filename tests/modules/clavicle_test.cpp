// SPDX-License-Identifier: MIT
// clavicle: shrugs a shoulder with the arm on it.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

test::Commands shoulders() {
  test::Commands commands{{"chest", "{command: control, with: {}}"}};
  for (const std::string s : {"l", "r"}) {
    commands["clavicle_" + s] = "{command: clavicle, with: {shoulder: arm_" + s + ".upper}}";
    commands["upperarm_" + s] = "{command: control, with: {}}";
  }
  return commands;
}

/// Middle of the box around what a control shows, rig space.
Vec3 shown_at(const test::Rig& rig, const std::string& control) {
  const auto points = std::get<std::vector<double>>(
      rig.scene().value({rig.node(control), scene::control::kPoints}));
  Vec3 least{1e9, 1e9, 1e9}, most = -least;
  for (std::size_t i = 0; i < points.size();) {
    const auto count = static_cast<std::size_t>(points[i++]);
    for (std::size_t p = 0; p < count; ++p, i += 3) {
      const Vec3 at = rig.rest(control) * Vec3{points[i], points[i + 1], points[i + 2]};
      least = {std::min(least.x, at.x), std::min(least.y, at.y), std::min(least.z, at.z)};
      most = {std::max(most.x, at.x), std::max(most.y, at.y), std::max(most.z, at.z)};
    }
  }
  return (least + most) * 0.5;
}

}  // namespace

TEST_CASE("modules clavicle: lifting it lifts the shoulder, and the joint stays in the chest") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(shoulders()), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    pose.turn_in_world("arm_l.clavicle/clavicle",
                       test::mapped(model.by, math::from_euler_degrees({0, 0, 20})));
    const double height = rig.skeleton.character.height;
    const Vec3 inner{0.03, 1.45, 0}, outer{0.15, -0.01, 0};
    const Vec3 lifted = inner + math::rotate(math::from_euler_degrees({0, 0, 20}), outer);
    CHECK(test::distance(pose.position("arm_l.clavicle"), model.by * inner) < 1e-9 * height);
    CHECK(test::distance(pose.position("arm_l.upper"), model.by * lifted) < 1e-9 * height);
  }
}

TEST_CASE("modules clavicle: the shape stands above the bone, on both sides") {
  const test::Rig rig(test::body(shoulders()), test::mirror_right_side);
  const Vec3 left = shown_at(rig, "arm_l.clavicle/clavicle");
  const Vec3 right = shown_at(rig, "arm_r.clavicle/clavicle");
  CHECK(left.x == doctest::Approx(0.105).epsilon(0.01));
  CHECK(left.y > 1.45);
  CHECK(test::distance(right, {-left.x, left.y, left.z}) < 1e-3);
}
