// SPDX-License-Identifier: MIT
// vector_foot: the foot leans to any side over the edge of its sole.
#include <doctest/doctest.h>

#include <algorithm>

#include "modules/legs_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kFeet = "toes: \"leg_{s}.ball/control\", tip: \"leg_{s}.tip\"}}";
const std::string kLean = "{command: vector_foot, with: {limb: \"leg_{s}/ik_fk_limb.ik\", " + kFeet;
const std::string kBoth =
    "{command: foot_roll, with: {limb: \"leg_{s}/ik_fk_limb.ik\", " + kFeet + "\n" + kLean;
const std::string kFoot = "leg_l/ik_fk_limb.ik", kVector = "leg_l/vector_foot.tweak";
constexpr double kLength = 0.2688;  // of the foot: what is behind the ankle is a quarter

/// Leaned by degrees toward a direction on the ground: 0 forward, 90 to the left; after a spin.
math::Quat lean(double toward, double degrees, double spin = 0) {
  const Vec3 direction{math::sin_degrees(toward), 0, math::cos_degrees(toward)};
  return math::from_euler_degrees({0, spin, 0}) *
         math::axis_angle(math::cross({0, 1, 0}, direction), math::radians(degrees));
}

test::Pose leaned(const test::Rig& rig, const math::Quat& by) {
  test::Pose pose(rig);
  pose.translate(kFoot, {0, 0.25, 0});
  pose.turn(kVector, by);
  return pose;
}

/// The edge of the sole at rest, an ellipse about the line from heel to tip, in 36 points.
std::vector<Vec3> outline() {
  const Vec3 ankle{0.11, 0, -0.01}, tip{0.135, 0, 0.19};
  const Vec3 ahead = math::normalised(tip - ankle);
  const Vec3 side = math::cross({0, 1, 0}, ahead), middle = tip - ahead * (kLength / 2);
  std::vector<Vec3> points;
  for (int i = 0; i < 36; ++i) {
    const double angle = 10.0 * i;
    points.push_back(middle + ahead * (math::cos_degrees(angle) * kLength / 2) +
                     side * (math::sin_degrees(angle) * kLength * 0.18));
  }
  return points;
}

/// The edge in a pose whose toes are not bent, lowered by how far the foot was raised.
std::vector<Vec3> outline_in(const test::Rig& rig, const test::Pose& pose) {
  const math::Affine moved = pose.world("leg_l.end") * math::inverse(rig.rest("leg_l.end"));
  std::vector<Vec3> points;
  for (const Vec3& point : outline()) points.push_back(moved * point - Vec3{0, 0.25, 0});
  return points;
}

double lowest(const std::vector<Vec3>& points) {
  double y = 1;
  for (const Vec3& point : points) y = std::min(y, point.y);
  return y;
}

}  // namespace

TEST_CASE("modules vector_foot: at rest nothing moves, with and without foot_roll") {
  for (const std::string& commands : {kLean, kBoth}) {
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      const test::Rig rig(test::legs(commands), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
    }
  }
}

TEST_CASE("modules vector_foot: leaned to any side the foot stands on its edge and sinks nowhere") {
  const test::Rig rig(test::legs(kBoth));
  for (int toward = 0; toward < 360; toward += 7) {
    for (const double angle : {0.2, 0.6, 1.5, 5.0, 20.0, 40.0, 60.0}) {
      for (const double spin : {0.0, 30.0}) {
        CAPTURE(toward);
        CAPTURE(angle);
        const double y = lowest(outline_in(rig, leaned(rig, lean(toward, angle, spin))));
        CHECK(y > -0.005 * kLength);
        if (angle > 5) CHECK(y < 0.01 * kLength);
      }
    }
  }
}

TEST_CASE("modules vector_foot: the foot leans the way the control leans") {
  const test::Rig rig(test::legs(kBoth));
  const auto sole = [&](double toward) { return outline_in(rig, leaned(rig, lean(toward, 30))); };
  const auto forward = sole(0), back = sole(180), left = sole(90), right = sole(-90);
  CHECK(std::abs(forward[0].y) < 0.006);  // on the tip
  CHECK(forward[18].y > 0.1);
  CHECK(std::abs(back[18].y) < 0.006);  // on the heel
  CHECK(back[0].y > 0.1);
  CHECK(left[27].y > 0.04);
  CHECK(right[9].y > 0.04);
}

TEST_CASE("modules vector_foot: wherever the control turns, the foot follows without a jump") {
  const test::Rig rig(test::legs(kBoth));
  std::vector<std::vector<math::Quat>> paths(3);
  for (int i = 0; i <= 360; ++i) {
    paths[0].push_back(lean(i, 35));             // round the edge
    paths[1].push_back(lean(20, 60 - i / 3.0));  // from one side through rest to the other
    paths[2].push_back(lean(90, 30, i));         // spun on the ground
  }
  for (const auto& path : paths) {
    std::vector<Vec3> last;
    double most = 0;
    for (const math::Quat& turn : path) {
      const auto now = outline_in(rig, leaned(rig, turn));
      for (std::size_t i = 0; i < last.size(); ++i)
        most = std::max(most, test::distance(last[i], now[i]));
      last = now;
    }
    CHECK(most < 0.02 * kLength);  // a degree a step
  }
}

TEST_CASE("modules vector_foot: a share of a lean forward bends the foot over its ball") {
  const test::Rig rig(test::legs(kBoth));
  const test::Pose rest = leaned(rig, {});
  test::Pose bent = leaned(rig, lean(0, 30));
  bent.set(kVector + "@ball", 1.0);
  // The ball's axis lies across the foot, which points a little outward.
  CHECK(test::distance(bent.position("leg_l.ball"), rest.position("leg_l.ball")) < 0.02);
  CHECK(bent.position("leg_l.end").y > rest.position("leg_l.end").y + 0.04);
  test::Pose half = leaned(rig, lean(0, 30));
  half.set(kVector + "@ball", 0.5);
  const Vec3 tip = half.position("leg_l.tip") - rest.position("leg_l.tip");
  CHECK(math::length(tip) < 0.02);
  test::Pose back = leaned(rig, lean(180, 30)), same = back;
  back.set(kVector + "@ball", 1.0);
  CHECK(test::distance(back.position("leg_l.tip"), same.position("leg_l.tip")) < 1e-9);
}

TEST_CASE("modules vector_foot: without toes a share of a lean forward turns the foot on its tip") {
  std::string commands = kBoth;
  const std::string toes = "toes: \"leg_{s}.ball/control\", ";
  for (auto at = commands.find(toes); at != std::string::npos; at = commands.find(toes))
    commands.erase(at, toes.size());
  const test::Rig rig(test::legs(commands));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const test::Pose rest = leaned(rig, {});
  for (const double angle : {0.2, 1.0, 5.0, 20.0, 40.0, 60.0}) {
    for (const double ball : {0.5, 1.0}) {
      CAPTURE(angle);
      CAPTURE(ball);
      test::Pose bent = leaned(rig, lean(0, angle));
      bent.set(kVector + "@ball", ball);
      CHECK(lowest(outline_in(rig, bent)) > -0.01 * kLength);
      if (angle > 5) CHECK(bent.position("leg_l.end").y > rest.position("leg_l.end").y + 0.03);
    }
  }
}

TEST_CASE("modules vector_foot: leaning and rolling add to one another") {
  const test::Rig rig(test::legs(kBoth));
  test::Pose rolled = leaned(rig, {}), both = leaned(rig, lean(90, 20));
  rolled.set(kFoot + "@roll", 30.0);
  both.set(kFoot + "@roll", 30.0);
  CHECK(both.position("leg_l.end").x > rolled.position("leg_l.end").x + 0.02);
  CHECK(both.position("leg_l.end").y > 0.33);
}

TEST_CASE("modules vector_foot: mirrored values give the mirrored pose, on every model alike") {
  const auto posed = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    for (const auto& [side, sign] : {std::pair{std::string("l"), 1.0}, {"r", -1.0}}) {
      const std::string foot = "leg_" + side + "/ik_fk_limb.ik";
      pose.move_to(foot, by * Vec3{0.11 * sign, 0.33, -0.01});
      pose.turn_in_world("leg_" + side + "/vector_foot.tweak",
                         test::mapped(by, lean(40 * sign, 25, 10 * sign)));
      pose.set("leg_" + side + "/vector_foot.tweak@ball", 0.3);
    }
    return pose;
  };
  const test::Rig plain(test::legs(kBoth), test::mirror_right_side);
  const auto expected = test::motion(plain, posed(plain, {}));
  CHECK(test::motion_difference(plain, test::mirror_image(plain, expected), expected) < 1e-9);
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::legs(kBoth), [&](tags::TaggedSkeleton& skeleton) {
      test::mirror_right_side(skeleton);
      if (model.change) model.change(skeleton);
    });
    CHECK(test::motion_difference(rig, test::motion(rig, posed(rig, model.by)),
                                  test::mapped(model.by, expected)) < 1e-7);
  }
}

TEST_CASE("modules vector_foot: a limb leans once") {
  std::string again = kLean;
  again.replace(again.find("vector_foot,"), 12, "vector_foot, id: again,");
  const test::Rig rig(test::legs(kLean + "\n" + again));
  CHECK(test::codes(rig.diagnostics) == "RIG0464");
}
