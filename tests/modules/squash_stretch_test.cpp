// SPDX-License-Identifier: MIT
// squash_stretch: the handle makes a joint longer and thinner, within limits, where it is on.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

std::string ball(const std::string& with = {}, const std::string& more = {}) {
  return test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: root, with: {}}
  - name: ball
    parent: base
    at: [0, 1, 0]
    local: ball
    label: ball
    tags:
      - {command: control, with: {}}
      - {command: squash_stretch, with: {joint: ., length: 0.5)" +
                           with + "}}\n" + more);
}

const std::string kHandle = "ball/squash_stretch.tweak";

Vec3 sizes(const test::Pose& pose) {
  const math::Mat3 m = pose.world("ball.ball").linear;
  return {math::length(m.x), math::length(m.y), math::length(m.z)};
}

}  // namespace

TEST_CASE("modules squash_stretch: the handle pulled away stretches, pushed in squashes") {
  const test::Rig rig(ball());
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-12);
  CHECK(test::distance(rig.rest(kHandle).origin, {0, 1.5, 0}) < 1e-12);
  for (const double length : {1.0, 0.6, 0.25}) {
    test::Pose pose(rig);
    pose.move_to(kHandle, {0, 1 + length, 0});
    const double ratio = length / 0.5;
    CHECK(test::distance(sizes(pose), {1 / math::sqrt(ratio), ratio, 1 / math::sqrt(ratio)}) <
          1e-9);
  }
}

TEST_CASE("modules squash_stretch: squash, volume, limits, off") {
  const test::Rig rig(ball(", most: 1.5"));
  test::Pose pose(rig);
  pose.set(kHandle + "@squash", 0.21).set(kHandle + "@volume", 0.0);
  CHECK(test::distance(sizes(pose), {1, 1.21, 1}) < 1e-9);
  pose.set(kHandle + "@volume", 1.0);
  CHECK(test::distance(sizes(pose), {1 / 1.1, 1.21, 1 / 1.1}) < 1e-9);
  pose.set(kHandle + "@squash", 4.0);
  CHECK(sizes(pose).y == doctest::Approx(1.5));
  pose.set(kHandle + "@active", 0.0);
  CHECK(test::distance(sizes(pose), {1, 1, 1}) < 1e-12);
}

TEST_CASE("modules squash_stretch: a larger character is not more stretched") {
  const test::Rig rig(ball());
  test::Pose pose(rig);
  pose.set("base/root.world@master_scale", 3.0);
  CHECK(test::distance(sizes(pose), {3, 3, 3}) < 1e-9);
  pose.rotate("ball/control", {40, 0, 20}).translate(kHandle, {0.5, 0, 0});
  CHECK(sizes(pose).y == doctest::Approx(6));
}

TEST_CASE("modules squash_stretch: it rests on every model, and stretches as far") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(ball(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose pose(rig);
    const Vec3 at = rig.rest("ball.ball").origin, end = rig.rest(kHandle).origin;
    pose.move_to(kHandle, at + (end - at) * 2);
    const double before = math::determinant(rig.rest("ball.ball").linear);
    const math::Mat3 now = pose.world("ball.ball").linear;
    CHECK(math::determinant(now) == doctest::Approx(before).epsilon(1e-9));
    const Vec3 rest_size{math::length(rig.rest("ball.ball").linear.x), 0, 0};
    const double longest =
        std::fmax(math::length(now.x), std::fmax(math::length(now.y), math::length(now.z)));
    CHECK(longest == doctest::Approx(2 * rest_size.x).epsilon(1e-9));
  }
}

TEST_CASE("modules squash_stretch: what moves by itself below would be sheared") {
  const std::string eye = R"(  - name: eye
    parent: ball
    at: [0, 1.2, 0]
    local: eye
    label: eye
    tags:
      - {command: control, with: {}}
)";
  const test::Rig rig(ball({}, eye));
  CHECK(test::codes(rig.diagnostics) == "RIG0860");
}
