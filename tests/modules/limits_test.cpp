// SPDX-License-Identifier: MIT
// limits: what an animator sees of controls and joints that go so far and no further.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kHips = "torso.hips/control";
const std::string kHead = "head.head/control";

/// The hips with a control, and limits on what `with` says.
std::string hips(const std::string& with, const std::string& control = "{}") {
  return test::body({{"hips", "{command: control, with: " + control +
                                  "}\n{command: limits, with: {" + with + "}}"}});
}

Vec3 placed(const test::Rig& rig, Vec3 key) {
  return test::Pose(rig).translate(kHips, key).position("torso.hips") - Vec3{0, 0.95, 0};
}

bool near(Vec3 a, Vec3 b) { return test::distance(a, b) < 1e-9; }

/// The angles of a joint's turn from its rest, in the character's axes.
Vec3 turn(const test::Rig& rig, const math::Affine& world, const std::string& joint) {
  const math::Mat3 rest = math::orthonormal(rig.rest(joint).linear);
  const math::Mat3 now = math::orthonormal(world.linear);
  return math::to_euler_degrees(math::quaternion(now * math::transposed(rest)));
}

}  // namespace

TEST_CASE("modules limits: the key stays, its effect stops at the limit") {
  const test::Rig rig(hips("min_translate_y: -0.2, max_translate_y: 0.3, max_translate_x: 0.1"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(near(placed(rig, {0.05, 0.1, 5}), {0.05, 0.1, 5}));
  CHECK(near(placed(rig, {0.5, 1, 5}), {0.1, 0.3, 5}));
  CHECK(near(placed(rig, {-7, -1, -5}), {-7, -0.2, -5}));
  // The control itself stands where the joint does: its shape stops too.
  test::Pose pose(rig);
  pose.translate(kHips, {0, 1, 0});
  CHECK(near(pose.position(kHips), pose.position("torso.hips")));
}

TEST_CASE("modules limits: what reads a limited attribute gets the limited value") {
  const test::Rig rig(
      test::body({{"hips",
                   "{command: control, with: {drive: off}}\n"
                   "{command: limits, with: {min_translate_y: 0, max_translate_y: 0.1}}\n"
                   "{command: expression, with: {to: head.head@rotate.y, value: "
                   "\"{torso.hips/control@translate.y} * 900\"}}"}}));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(std::abs(test::Pose(rig).translate(kHips, {0, 0.05, 0}).number("head.head@rotate.y") - 45) <
        1e-9);
  CHECK(std::abs(test::Pose(rig).translate(kHips, {0, 9, 0}).number("head.head@rotate.y") - 90) <
        1e-9);
  CHECK(test::Pose(rig).translate(kHips, {0, -9, 0}).number("head.head@rotate.y") == 0);
}

TEST_CASE("modules limits: lengths are in metres whatever the model's size") {
  const test::Rig rig(hips("max_translate_y: 0.3"),
                      [](auto& s) { test::transform(s, test::similarity(100, {})); });
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  CHECK(near(pose.translate(kHips, {0, 500, 0}).position("torso.hips"), {0, 95 + 30, 0}));
}

TEST_CASE("modules limits: a hinge bends one way") {
  const test::Rig rig(
      hips("min_rotate_x: 0, max_rotate_x: 150, min_rotate_y: 0, max_rotate_y: 0, "
           "min_rotate_z: 0, max_rotate_z: 0"));
  REQUIRE(rig.clean());
  const auto bent = [&](Vec3 degrees) {
    return turn(rig, test::Pose(rig).rotate(kHips, degrees).world("torso.hips"), "torso.hips");
  };
  CHECK(near(bent({40, 0, 0}), {40, 0, 0}));
  CHECK(near(bent({40, 20, -10}), {40, 0, 0}));
  CHECK(near(bent({-40, 0, 0}), {0, 0, 0}));
  CHECK(near(bent({170, 0, 0}), {150, 0, 0}));
}

TEST_CASE("modules limits: scale stops too") {
  const test::Rig rig(hips("min_scale_x: 0.5, max_scale_x: 2, max_scale_y: 1.5", "{scale: on}"));
  REQUIRE(rig.clean());
  const auto scaled = [&](Vec3 key) {
    const math::Mat3 m = test::Pose(rig).set(kHips + "@scale", key).world("torso.hips").linear;
    return Vec3{math::length(m.x), math::length(m.y), math::length(m.z)};
  };
  CHECK(near(scaled({3, 3, 3}), {2, 1.5, 3}));
  CHECK(near(scaled({0.1, 0.1, 0.1}), {0.5, 0.1, 0.1}));
}

TEST_CASE("modules limits: what several commands say holds together") {
  const test::Rig rig(test::body({{"hips",
                                   "{command: control}\n"
                                   "{command: limits, id: a, with: {max_translate_x: 0.5}}\n"
                                   "{command: limits, id: b, with: {max_translate_x: 0.2, "
                                   "min_translate_z: 0}}"}}));
  REQUIRE(rig.clean());
  CHECK(near(placed(rig, {1, 1, -1}), {0.2, 1, 0}));
}

TEST_CASE("modules limits: several controls at once, each measured on its own") {
  const test::Rig rig(test::body({{"hips", "{command: control}"},
                                  {"head",
                                   "{command: control}\n{command: limits, with: {nodes: "
                                   "[torso.hips/control, ./control], max_translate_y: 0.1}}"}}));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.translate(kHips, {0, 1, 0}).translate(kHead, {0, 1, 0});
  CHECK(near(pose.position("head.head"), {0, 1.6 + 0.2, 0.02}));
}

TEST_CASE("modules limits: a selector that may find nothing skips the command or leaves it away") {
  const test::Rig rig(hips("nodes: \"tail.none?\", max_translate_y: 0.1"));
  CHECK(rig.diagnostics.ok());
  CHECK(near(placed(rig, {0, 1, 0}), {0, 1, 0}));
}

TEST_CASE("modules limits: a joint is limited from its rest, the same on every model") {
  const std::string limits =
      "{command: limits, with: {nodes: ., axes: character, min_rotate_y: -30, max_rotate_y: 45, "
      "max_rotate_x: 20, max_translate_y: 0.05}}";
  const std::string text =
      test::body({{"hips", "{command: control}"}, {"head", "{command: control}\n" + limits}});
  const auto nod = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    const double unit = rig.skeleton.character.unit;
    pose.turn_in_world(kHips, test::mapped(by, math::from_euler_degrees({0, 0, 30})));
    pose.turn_in_world(kHead, test::mapped(by, math::from_euler_degrees({50, 80, 0})));
    pose.translate(kHead, {0, unit, 0});
    return test::motion(rig, pose);
  };
  const test::Rig plain(text);
  REQUIRE(plain.clean());
  const auto expected = nod(plain, {});
  const math::Affine hips = test::Pose(plain)
                                .turn_in_world(kHips, math::from_euler_degrees({0, 0, 30}))
                                .world("torso.hips");
  // 50 and 80 degrees became 20 and 45, a metre five centimetres.
  const math::Affine head = math::inverse(hips) * expected[5] * plain.rest("head.head");
  CHECK(near(math::to_euler_degrees(math::quaternion(head.linear)), {20, 45, 0}));
  CHECK(near(head.origin, {0, 1.6 - 0.95 + 0.05, 0.02}));
  for (const test::Model& model : test::models()) {
    // Where space itself is mirrored, left and right turns are exchanged.
    if (math::determinant(model.by.linear) < 0) continue;
    CAPTURE(model.name);
    const test::Rig rig(text, model.change);
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    CHECK(test::motion_difference(rig, nod(rig, model.by), test::mapped(model.by, expected)) <
          1e-9);
  }
}

TEST_CASE("modules limits: both sides of a character stop at mirrored places") {
  for (const std::string orient : {"character", "bone", "joint"}) {
    CAPTURE(orient);
    test::Commands commands;
    for (const char* side : {"l", "r"}) {
      commands[std::string("upperarm_") + side] =
          "{command: control, with: {orient: " + orient +
          "}}\n{command: limits, with: {min_rotate_x: -10, max_rotate_y: 20, min_rotate_z: -5, "
          "max_translate_x: 0.1, min_translate_z: -0.2}}";
    }
    const test::Rig rig(test::body(commands), [](auto& s) { test::mirror_right_side(s); });
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    const std::string left = "arm_l.upper/control", right = "arm_r.upper/control";
    const auto signs = std::get<std::vector<double>>(rig.scene().value(rig.plug(left + "@mirror")));
    REQUIRE(signs.size() == 3);
    test::Random random(5);
    for (int i = 0; i < 20; ++i) {
      const Vec3 key = random.vector(0.5), degrees = random.vector(60);
      Vec3 other_key, other_degrees;
      for (std::size_t c = 0; c < 3; ++c) {
        other_key[c] = signs[c] * key[c];
        other_degrees[c] = -signs[c] * degrees[c];
      }
      test::Pose both(rig);
      both.translate(left, key).rotate(left, degrees);
      both.translate(right, other_key).rotate(right, other_degrees);
      const auto motion = test::motion(rig, both);
      CHECK(test::motion_difference(rig, motion, test::mirror_image(rig, motion)) < 1e-9);
    }
  }
}

TEST_CASE("modules limits: a limit that cannot be mirrored is left away and said") {
  test::Commands commands;
  for (const char* side : {"l", "r"}) {
    commands[std::string("upperarm_") + side] =
        "{command: control, with: {orient: joint}}\n"
        "{command: limits, with: {max_translate_x: 0.1}}";
  }
  const test::Rig rig(test::body(commands), [](auto& s) {
    test::mirror_right_side(s);
    test::turn_axes(s, 3);
  });
  CHECK(test::codes(rig.diagnostics) == "RIG0492");
  CHECK(rig.diagnostics.ok());
  CHECK(rig.nodes("arm_l.upper/limits").size() == 1);
  CHECK(rig.nodes("arm_r.upper/limits").empty());
}

TEST_CASE("modules limits: mistakes are said at the parameter") {
  const auto place = [](const std::string& with, const std::string& control = "{}") {
    const test::Rig rig(hips(with, control));
    return test::codes(rig.diagnostics);
  };
  CHECK(place("min_translate_x: 0.2, max_translate_x: 0.1") == "RIG0490");
  CHECK(place("min_translate_x: 0.1, max_translate_x: -0.1, min_scale_y: 2, max_scale_y: 1") ==
        "RIG0490 RIG0490");
  CHECK(place("min_translate_x: 0.1") == "RIG0491");  // it rests at 0
  CHECK(place("max_rotate_z: -1") == "RIG0491");
  CHECK(place("max_scale_x: 0.9") == "RIG0491");
  CHECK(place("axes: bone") == "RIG0493");
  CHECK(place("nodes: ./control.driver, max_scale_x: 2") == "RIG0468");
}

TEST_CASE("modules limits: a value that `set` gave counts as rest") {
  const auto clean = [](const std::string& limit) {
    return test::Rig(test::body({{"hips",
                                  "{command: control}\n"
                                  "{command: set, with: {plug: ./control@translate.x, value: 3}}\n"
                                  "{command: limits, with: {" +
                                      limit + "}}"}}))
        .clean();
  };
  CHECK(clean("min_translate_x: 2, max_translate_x: 4"));
  CHECK_FALSE(clean("max_translate_x: 2"));
}
