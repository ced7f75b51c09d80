// SPDX-License-Identifier: MIT
// pivot: a body turns about the point that an animator chose.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const test::Commands kBody{{"hips",
                            "{command: control, with: {scale: on}}\n"
                            "{command: pivot, with: {}}"},
                           {"chest", "{command: control, with: {}}"}};
const std::string kHips = "torso.hips/control", kPivot = "torso.hips/pivot";

test::Pose turned(const test::Rig& rig, const math::Affine& by, Vec3 pivot) {
  test::Pose pose(rig);
  pose.move_to(kPivot, by * pivot);
  pose.turn_in_world(kHips, test::mapped(by, math::from_euler_degrees({0, 0, 30})));
  return pose;
}

}  // namespace

TEST_CASE("modules pivot: the body turns about it, on every model") {
  const Vec3 foot{0.1, 0.08, 0};
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(kBody), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    const test::Pose pose = turned(rig, model.by, foot);
    const auto motion = test::mapped(math::inverse(model.by), test::motion(rig, pose));
    const math::Quat turn = math::from_euler_degrees({0, 0, 30});
    for (const Vec3 rest : {foot, Vec3{0, 0.95, 0}, Vec3{0.3, 1.6, 0.1}}) {
      CHECK(test::distance(motion[1] * rest, foot + math::rotate(turn, rest - foot)) < 1e-9);
    }
  }
}

TEST_CASE("modules pivot: moving it moves nothing while the body is not turned") {
  const test::Rig rig(test::body(kBody));
  test::Pose pose(rig);
  pose.translate(kPivot, {0.4, -0.9, 0.3});
  CHECK(test::motion_difference(rig, test::motion(rig, pose),
                                std::vector<math::Affine>(rig.skeleton.joints.size())) < 1e-12);
}

TEST_CASE("modules pivot: it goes along where the body is moved, and stays where it is turned") {
  const test::Rig rig(test::body(kBody));
  test::Pose pose(rig);
  pose.translate(kHips, {0.2, 0.1, 0.5}).translate(kPivot, {0, -0.9, 0});
  CHECK(test::distance(pose.position(kPivot), {0.2, 0.15, 0.5}) < 1e-12);
  pose.rotate(kHips, {0, 70, 20});
  CHECK(test::distance(pose.position(kPivot), {0.2, 0.15, 0.5}) < 1e-12);
  pose.set(kHips + "@scale", Vec3{2, 2, 2});
  CHECK(test::distance(pose.position(kPivot), {0.2, 0.15, 0.5}) < 1e-12);
  // What the pivot holds fast stands still while the body turns and grows.
  const Vec3 held{0.2, 0.15, 0.5};
  const Vec3 at_rest = held - Vec3{0.2, 0.1, 0.5};
  const math::Affine motion = pose.world("torso.hips") * math::inverse(rig.rest("torso.hips"));
  CHECK(test::distance(motion * at_rest, held) < 1e-12);
}

TEST_CASE("modules pivot: hidden until it is asked for") {
  const test::Rig rig(test::body(kBody));
  test::Pose pose(rig);
  CHECK(pose.number(kPivot + "@visible") == 0);
  CHECK(pose.set(kHips + "@pivot_visible", 1.0).number(kPivot + "@visible") == 1);
}
