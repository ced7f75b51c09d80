// SPDX-License-Identifier: MIT
// chain: FK that spreads, IK that reaches, a spline that stretches, and what lies between them.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

std::string tail(int count, const std::string& with = {}) {
  return test::tail(count, {{"base", "{command: root, with: {}}\n{command: control, with: {}}"},
                            {"tail", "{command: chain, with: {joints: \"tail[*]\"" + with + "}}"}});
}

const std::string kSettings = "tail[0]/chain.settings";
const std::string kEnd = "tail[END]/chain.ik";
std::string fk(int i) { return "tail[" + std::to_string(i) + "]/chain.fk"; }
std::string joint(int i) { return "tail[" + std::to_string(i) + "]"; }

double bend_at(const test::Pose& pose, int i) {
  const Vec3 a = pose.position(joint(i)) - pose.position(joint(i - 1));
  const Vec3 b = pose.position(joint(i + 1)) - pose.position(joint(i));
  return math::degrees(math::acos(math::dot(math::normalised(a), math::normalised(b))));
}

}  // namespace

TEST_CASE("modules chain: it rests where it rests, short or long") {
  for (const int count : {2, 3, 12}) {
    const test::Rig rig(tail(count));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    for (const std::string mode : {"ik_fk", "spline"}) {
      test::Pose pose(rig);
      pose.set(kSettings + "@" + mode, 1.0);
      for (int i = 0; i < count; ++i)
        CHECK(test::distance(pose.position(joint(i)), rig.rest(joint(i)).origin) < 1e-5);
      pose.translate("base/control", {1, 2, 3});
      CHECK(test::distance(pose.position(joint(0)), rig.rest(joint(0)).origin + Vec3{1, 2, 3}) <
            1e-9);
    }
  }
}

TEST_CASE("modules chain: falloff hands a turn on along the chain") {
  const test::Rig rig(tail(6));
  test::Pose pose(rig);
  pose.turn_in_world(fk(1), math::from_euler_degrees({0, 20, 0}));
  CHECK(bend_at(pose, 1) == doctest::Approx(20));
  CHECK(bend_at(pose, 2) < 1e-4);
  pose.set(kSettings + "@falloff", 0.5);
  CHECK(bend_at(pose, 1) == doctest::Approx(20));
  CHECK(bend_at(pose, 2) == doctest::Approx(10));
  CHECK(bend_at(pose, 3) == doctest::Approx(5));
  pose.set(kSettings + "@falloff", 1.0);
  for (const int i : {1, 2, 3, 4}) CHECK(bend_at(pose, i) == doctest::Approx(20));
}

TEST_CASE("modules chain: in IK the end reaches its control and turns with it") {
  const test::Rig rig(tail(6));
  test::Pose pose(rig);
  pose.set(kSettings + "@ik_fk", 1.0);
  const double length = math::length(rig.rest(joint(5)).origin - rig.rest(joint(0)).origin);
  const Vec3 wanted = rig.rest(joint(0)).origin + Vec3{0.3, 0.2, -0.5} * length;
  pose.move_to(kEnd, wanted);
  CHECK(test::distance(pose.position(joint(5)), wanted) < 1e-5 * length);
  const auto lengths = test::bone_lengths(rig, pose.joints());
  CHECK(test::largest_difference(lengths, test::bone_lengths(rig, test::Pose(rig).joints())) <
        1e-9);
  // Half way the joints lie between.
  const Vec3 ik = pose.position(joint(3));
  pose.set(kSettings + "@ik_fk", 0.5);
  const Vec3 half = pose.position(joint(3));
  CHECK(test::distance(half, ik) > 1e-3);
  CHECK(test::distance(half, rig.rest(joint(3)).origin) > 1e-3);
}

TEST_CASE("modules chain: on the spline it passes through the controls, or keeps its length") {
  const test::Rig rig(tail(7, ", spline: 1, spline_controls: 3"));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  const auto tweaks = rig.nodes("tail/chain.tweak");
  REQUIRE(tweaks.size() == 3);
  test::Pose pose(rig);
  const Vec3 first = rig.rest(joint(0)).origin, last = rig.rest(joint(6)).origin;
  const double bone = math::length(last - first) / 6;
  pose.move_to("tail/chain.tweak[2]", last + Vec3{0, 2 * bone, -bone});
  CHECK(test::distance(pose.position(joint(6)), last + Vec3{0, 2 * bone, -bone}) < 1e-9);
  CHECK(test::distance(pose.position(joint(0)), first) < 1e-9);
  for (int i = 1; i < 6; ++i) CHECK(bend_at(pose, i) < 25);
  pose.set(kSettings + "@stretch", 0.0);
  for (int i = 1; i < 7; ++i)
    CHECK(math::length(pose.position(joint(i)) - pose.position(joint(i - 1))) ==
          doctest::Approx(bone).epsilon(1e-9));
}

TEST_CASE("modules chain: the same motion on every model") {
  const auto move = [](const test::Rig& rig, const math::Affine& by, double mode) {
    test::Pose pose(rig);
    pose.set(kSettings + "@falloff", 0.7).set(kSettings + "@spline", mode);
    pose.turn_in_world(fk(1), test::mapped(by, math::from_euler_degrees({10, 20, 0})));
    const std::string middle = "tail/chain.tweak[1]";
    pose.move_to(middle, pose.position(middle) + by.linear * Vec3{0.1, 0.05, 0});
    return test::motion(rig, pose);
  };
  for (const double mode : {0.0, 0.4}) {
    const test::Rig plain(tail(5));
    const auto expected = move(plain, {}, mode);
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      const test::Rig rig(tail(5), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
      CHECK(test::motion_difference(rig, move(rig, model.by, mode),
                                    test::mapped(model.by, expected)) < 1e-8);
    }
  }
}

TEST_CASE("modules chain: FK alone, and one joint is too few") {
  const test::Rig rig(tail(4, ", ik: off, spline_controls: 0"));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  CHECK(rig.nodes("tail/chain.ik").empty());
  CHECK(!rig.scene().find_plug(rig.node(kSettings), "ik_fk"));
  const test::Rig one(test::tail(3, {{"tail", "{command: chain, with: {joints: .}}"}}));
  CHECK(test::codes(one.diagnostics) == "RIG0461");
}
