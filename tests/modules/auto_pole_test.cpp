// SPDX-License-Identifier: MIT
// auto_pole: the knee goes with leg and foot, and never flips.
#include <doctest/doctest.h>

#include <algorithm>

#include "modules/legs_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kPole =
    "{command: auto_pole, with: {limb: \"leg_{s}/ik_fk_limb.ik\", body: "
    "\"torso.hips/control#body\"}}";
const std::string kFoot = "leg_l/ik_fk_limb.ik", kKnee = "leg_l/ik_fk_limb.pole";
const Vec3 kHip{0.1, 0.9, 0};
/// Above, inward and behind the left hip: where a direction has to be quick to turn through.
const Vec3 kQuick = math::normalised(Vec3{-1, 2, -1});

double degrees_between(Vec3 a, Vec3 b) { return math::degrees(math::acos(math::dot(a, b))); }

/// How far the knee moves at most for a step of the ankle, in lengths of that step; steps nearer
/// to the quick direction than `spared` degrees are left out.
double quickest(const test::Rig& rig, const std::vector<Vec3>& path, double spared) {
  double most = 0;
  Vec3 knee, ankle;
  bool counts = false;
  for (const Vec3& point : path) {
    test::Pose pose(rig);
    pose.move_to(kFoot, point);
    const Vec3 new_knee = pose.position("leg_l.lower"), new_ankle = pose.position("leg_l.end");
    const bool near = degrees_between(math::normalised(point - kHip), kQuick) < spared;
    if (counts && !near)
      most = std::max(most, test::distance(knee, new_knee) / test::distance(ankle, new_ankle));
    knee = new_knee;
    ankle = new_ankle;
    counts = !near;
  }
  return most;
}

std::vector<Vec3> circle(Vec3 centre, Vec3 x, Vec3 y, double radius, int steps = 720) {
  std::vector<Vec3> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = 2 * math::kPi * i / steps;
    points.push_back(centre + (x * math::cos(angle) + y * math::sin(angle)) * radius);
  }
  return points;
}

}  // namespace

TEST_CASE("modules auto_pole: at rest nothing moves") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::legs(kPole), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
  }
}

TEST_CASE("modules auto_pole: without it the knee snaps where the leg passes its pole") {
  const test::Rig rig(test::legs(""));
  CHECK(quickest(rig, circle(kHip, {0, -1, 0}, math::normalised(Vec3{0.01, 0, 1}), 0.6), 0) > 10);
}

TEST_CASE("modules auto_pole: full circles of the ankle round the hip leave the knee calm") {
  const test::Rig rig(test::legs(kPole));
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const double radius : {0.35, 0.6, 0.75}) {
    for (int i = 0; i < 3; ++i) {
      CAPTURE(radius);
      CAPTURE(i);
      CHECK(quickest(rig, circle(kHip, axes[i], axes[(i + 1) % 3], radius), 0) < 7);
    }
    // Slightly beside straight above the hip.
    CHECK(quickest(rig, circle(kHip, {0, -1, 0}, math::normalised(Vec3{0.03, 0, 1}), radius), 0) <
          7);
  }
}

TEST_CASE("modules auto_pole: a circle behind the hip leaves the knee calm") {
  const test::Rig rig(test::legs(kPole));
  for (const double radius : {0.1, 0.3, 0.5})
    CHECK(quickest(rig, circle(kHip + Vec3{0, 0, -0.35}, {1, 0, 0}, {0, 1, 0}, radius), 0) < 6);
}

TEST_CASE("modules auto_pole: circles in any plane leave the knee calm but for one direction") {
  const test::Rig rig(test::legs(kPole));
  test::Random random(3);
  double most = 0;
  for (int i = 0; i < 40; ++i) {
    const math::Mat3 axes = math::matrix(random.rotation());
    most = std::max(most,
                    quickest(rig, circle(kHip, axes.x, axes.y, random.number(0.3, 0.79), 360), 20));
  }
  CHECK(most < 10);
}

TEST_CASE("modules auto_pole: the pole is carried along and stays in front of the knee") {
  const test::Rig rig(test::legs(kPole));
  test::Pose seated(rig);
  seated.move_to(kFoot, kHip + Vec3{0.01, 0, 0.6});
  CHECK(seated.position(kKnee).y > 1.2);  // thigh forward: the knee points up
  CHECK(seated.position("leg_l.lower").y > kHip.y + 0.2);
  test::Pose behind(rig);
  behind.move_to(kFoot, kHip + Vec3{0.01, -0.1, -0.6});
  CHECK(behind.position(kKnee).y < 0.4);  // leg back: the knee points down
}

TEST_CASE("modules auto_pole: a turned foot takes the knee along in part") {
  const test::Rig rig(test::legs(kPole));
  test::Pose raised(rig);
  raised.translate(kFoot, {0, 0.2, 0});
  test::Pose turned = raised;
  turned.rotate(kFoot, {0, 40, 0});
  const Vec3 knee = turned.position("leg_l.lower") - raised.position("leg_l.lower");
  CHECK(knee.x > 0.03);
  CHECK(test::distance(turned.position("leg_l.end"), raised.position("leg_l.end")) < 1e-9);
  // All the way round without a jump.
  double last = 0, most = 0;
  for (int i = 0; i <= 720; ++i) {
    test::Pose pose = raised;
    pose.rotate(kFoot, {0, i * 0.5, 0});
    const double x = pose.position("leg_l.lower").x;
    if (i > 0) most = std::max(most, std::abs(x - last));
    last = x;
  }
  CHECK(most < 0.002);
}

TEST_CASE("modules auto_pole: off, the leg does what it did without") {
  const test::Rig plain(test::legs("")), rig(test::legs(kPole));
  const auto posed = [](const test::Rig& of) {
    test::Pose pose(of);
    pose.translate(kFoot, {0.3, 0.4, -0.4}).rotate(kFoot, {10, 30, 0});
    pose.translate(kKnee, {0.3, 0.1, -0.1});
    return pose;
  };
  test::Pose off = posed(rig);
  off.set(kFoot + "@auto_pole", 0.0);
  CHECK(test::motion_difference(rig, test::motion(rig, off), test::motion(plain, posed(plain))) <
        1e-12);
  CHECK(test::distance(posed(rig).position("leg_l.lower"), off.position("leg_l.lower")) > 0.01);
  test::Pose half = posed(rig);
  half.set(kFoot + "@auto_pole", 0.5);
  CHECK(test::distance(half.position("leg_l.lower"), off.position("leg_l.lower")) <
        test::distance(posed(rig).position("leg_l.lower"), off.position("leg_l.lower")));
}

TEST_CASE("modules auto_pole: the pole control moves the knee from where it is taken") {
  const test::Rig rig(test::legs(kPole));
  test::Pose pose(rig);
  pose.move_to(kFoot, kHip + Vec3{0.01, 0, 0.6});
  test::Pose moved = pose;
  moved.translate(kKnee, {0.4, 0, 0});
  CHECK(moved.position("leg_l.lower").x > pose.position("leg_l.lower").x + 0.05);
}

TEST_CASE("modules auto_pole: the hips take their share of the knee's plane along") {
  const test::Rig rig(test::legs(kPole));
  const auto knee = [&](double share) {
    test::Pose pose(rig);
    pose.translate(kFoot, {0, 0.2, 0}).set(kFoot + "@auto_twist", share);
    pose.rotate("torso.hips/control#hips", {0, 30, 0});
    const Vec3 hip = pose.position("leg_l.upper");
    return pose.position("leg_l.lower").x - hip.x;
  };
  CHECK(knee(1) > knee(0.5) + 0.02);
  CHECK(knee(0.5) > knee(0) + 0.02);
  // The body takes everything along, whatever the share.
  for (const double share : {0.0, 1.0}) {
    test::Pose pose(rig), turned(rig);
    for (test::Pose* each : {&pose, &turned}) each->set(kFoot + "@auto_twist", share);
    pose.move_to(kFoot, {0.11, 0.3, 0});
    const math::Affine turn = math::rotation(math::from_euler_degrees({0, 50, 0}));
    turned.turn_in_world("torso.hips/control#body", math::from_euler_degrees({0, 50, 0}));
    turned.move_to(kFoot, turn * Vec3{0.11, 0.3, 0});
    turned.turn_in_world(kFoot, math::from_euler_degrees({0, 50, 0}));
    CHECK(test::distance(turned.position("leg_l.lower"), turn * pose.position("leg_l.lower")) <
          1e-9);
  }
}

TEST_CASE("modules auto_pole: misaligned legs stay where they are, with any pole") {
  test::Random random(11);
  int bent = 0;
  for (int i = 0; i < 60; ++i) {
    const test::Rig rig(test::legs(kPole), [&](tags::TaggedSkeleton& skeleton) {
      auto worlds = test::worlds(skeleton);
      for (std::size_t j = 0; j < worlds.size(); ++j) {
        if (skeleton.joints[j].ids.label == "lower" || skeleton.joints[j].ids.label == "end")
          worlds[j].origin = worlds[j].origin + random.vector(0.08);
      }
      test::set_worlds(skeleton, worlds);
      test::turn_axes(skeleton, static_cast<std::uint64_t>(i));
    });
    REQUIRE(rig.clean());
    // Straighter legs bend to the stated side, whichever way they are out of line.
    const auto straight = [&](const std::string& leg) {
      const Vec3 knee = rig.rest(leg + ".lower").origin;
      const Vec3 thigh = math::normalised(knee - rig.rest(leg + ".upper").origin);
      return degrees_between(thigh, math::normalised(rig.rest(leg + ".end").origin - knee)) < 5;
    };
    if (straight("leg_l") || straight("leg_r")) continue;
    ++bent;
    CHECK(test::rest_error(rig) < 1e-9);
  }
  CHECK(bent > 40);
}

TEST_CASE("modules auto_pole: the same motion on every model") {
  const auto posed = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    pose.move_to(kFoot, by * Vec3{0.3, 0.7, 0.4});
    pose.turn_in_world(kFoot, test::mapped(by, math::from_euler_degrees({20, 40, 10})));
    pose.move_to("leg_r/ik_fk_limb.ik", by * Vec3{-0.2, 1.3, -0.3});
    pose.set(kFoot + "@auto_twist", 0.3);
    pose.turn_in_world("torso.hips/control#hips",
                       test::mapped(by, math::from_euler_degrees({5, 20, 10})));
    return pose;
  };
  const test::Rig plain(test::legs(kPole));
  const auto expected = test::motion(plain, posed(plain, {}));
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::legs(kPole), model.change);
    CHECK(test::motion_difference(rig, test::motion(rig, posed(rig, model.by)),
                                  test::mapped(model.by, expected)) < 1e-6);
  }
}

TEST_CASE("modules auto_pole: a limb has one") {
  const test::Rig rig(test::legs(kPole + "\n{command: auto_pole, id: again, with: {limb: "
                                         "\"leg_{s}/ik_fk_limb.ik\"}}"));
  CHECK(test::codes(rig.diagnostics) == "RIG0464");
}
