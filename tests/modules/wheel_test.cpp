// SPDX-License-Identifier: MIT
// wheel: rolls as far as its carrier has travelled.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

constexpr double kRadius = 0.3;

std::string cart(const std::string& wheel = "{command: wheel}") {
  return test::template_of(R"(joints:
  - name: cart
    at: [0, 0, 0]
    local: cart
    label: cart
    tags:
      - {command: root, with: {drive: on}}
  - name: wheel
    parent: cart
    at: [0.5, 0.3, 0.8]
    local: cart
    label: wheel
    tags:
      - )" + wheel + "\n");
}

/// Degrees that the wheel has turned about the character's left, seen from the cart.
double turned(const test::Rig& rig, const test::Pose& pose) {
  const math::Mat3 cart = math::orthonormal(pose.world("cart/root.offset").linear) *
                          math::transposed(math::orthonormal(rig.rest("cart/root.offset").linear));
  const math::Mat3 turn = math::orthonormal(pose.world("cart.wheel").linear) *
                          math::transposed(math::orthonormal(rig.rest("cart.wheel").linear));
  const Vec3 top = math::transposed(cart) * (turn * rig.skeleton.character.up);
  return math::degrees(math::atan2(math::dot(top, rig.skeleton.character.forward),
                                   math::dot(top, rig.skeleton.character.up)));
}

double degrees_of(double way) { return math::degrees(way / kRadius); }

}  // namespace

TEST_CASE("modules wheel: goes round as far as the cart goes forward, on every model") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(cart(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    for (const double way : {0.2, -0.35, 0.7}) {
      test::Pose pose(rig);
      pose.move_to("cart/root.world", model.by * Vec3{0.4, 0, way});
      CHECK(turned(rig, pose) == doctest::Approx(degrees_of(way)));
    }
  }
}

TEST_CASE("modules wheel: a larger cart rolls less, and growing alone does not roll") {
  const test::Rig rig(cart());
  test::Pose pose(rig);
  pose.set("cart/root.world@master_scale", 2.0);
  CHECK(turned(rig, pose) == doctest::Approx(0).epsilon(1e-9));
  pose.translate("cart/root.world", {0, 0, 0.3});
  CHECK(turned(rig, pose) == doctest::Approx(degrees_of(0.15)));
}

TEST_CASE("modules wheel: on a heading of its own it counts the way along that") {
  const test::Rig rig(cart());
  test::Pose pose(rig);
  pose.rotate("cart/root.world", {0, 90, 0}).translate("cart/root.world", {0.25, 0, 5});
  CHECK(turned(rig, pose) == doctest::Approx(degrees_of(0.25)));
}

TEST_CASE("modules wheel: auto_roll takes it away, the control adds by hand") {
  const test::Rig rig(cart());
  test::Pose pose(rig);
  pose.translate("cart/root.world", {0, 0, 0.1});
  pose.set("cart.wheel/wheel@auto_roll", 0.0);
  CHECK(turned(rig, pose) == doctest::Approx(0));
  pose.rotate("cart.wheel/wheel", {25, 0, 0});
  CHECK(turned(rig, pose) == doctest::Approx(25));
  pose.set("cart.wheel/wheel@auto_roll", 1.0);
  CHECK(turned(rig, pose) == doctest::Approx(25 + degrees_of(0.1)));
}

TEST_CASE("modules wheel: its size is given where the axle rests on the carrier") {
  const test::Rig given(cart("{command: wheel, with: {radius: 0.6}}"));
  test::Pose pose(given);
  pose.translate("cart/root.world", {0, 0, 0.3});
  CHECK(turned(given, pose) == doctest::Approx(degrees_of(0.15)));
}
