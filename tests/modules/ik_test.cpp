// SPDX-License-Identifier: MIT
// ik_handle: the end reaches what can be reached, the chain is exactly straight for what cannot,
// nothing changes its length.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cmath>

#include "modules/bodies_helpers.h"
#include "modules/hierarchy_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

constexpr double kReach = 1e-5;  // of the limb's length

std::string handle(const std::string& more) {
  return "{command: control, with: {drive: off}}\n"
         "{command: ik_handle, with: {start: limb.upper, end: limb.end, goal: ./control" +
         more + "}}";
}

/// Bones of 0.5 and 0.4, bent forward by about 23 degrees, below a base with a control.
std::string bent(const std::string& more = {}) {
  return test::limb("[0, 1, 0]", "[0, 0.51, 0.1]", "[0, 0.12, 0.02]",
                    {{"base", "{command: control, with: {}}"}, {"end", handle(more)}});
}

std::string straight(const std::string& more = {}) {
  return test::limb("[0, 1, 0]", "[0, 0.5, 0]", "[0, 0.1, 0]",
                    {{"base", "{command: control, with: {}}"}, {"end", handle(more)}});
}

const std::string kGoal = "limb.end/control";

struct Limb {
  Vec3 upper, lower, end;
  explicit Limb(const test::Pose& pose)
      : upper(pose.position("limb.upper")),
        lower(pose.position("limb.lower")),
        end(pose.position("limb.end")) {}
  double length() const { return test::distance(upper, lower) + test::distance(lower, end); }
  /// 0 where the three lie on one line.
  double deviation() const {
    const Vec3 along = math::normalised(end - upper);
    return math::length(math::cross(along, lower - upper)) / length();
  }
};

double length_error(const test::Rig& rig, const test::Pose& pose) {
  return test::largest_difference(test::bone_lengths(rig, pose.joints()),
                                  test::bone_lengths(rig, test::Pose(rig).joints())) /
         rig.skeleton.character.height;
}

/// Points within reach of the limb, in the template's space.
std::vector<Vec3> reachable() {
  std::vector<Vec3> points;
  test::Random random(11);
  while (points.size() < 12) {
    const Vec3 point = Vec3{0, 1, 0} + random.vector(0.85);
    const double distance = test::distance(point, {0, 1, 0});
    if (distance > 0.15 && distance < 0.88) points.push_back(point);
  }
  return points;
}

}  // namespace

TEST_CASE("modules ik: two bones reach what they can reach, at the lengths that they have") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(bent(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    for (const Vec3 point : reachable()) {
      test::Pose pose(rig);
      pose.move_to(kGoal, model.by * point);
      const Limb limb(pose);
      CHECK(test::distance(limb.end, model.by * point) < kReach * limb.length());
      CHECK(length_error(rig, pose) < 1e-9);
    }
  }
}

TEST_CASE("modules ik: two bones are exactly straight towards what is out of reach") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(bent(), model.change);
    for (const Vec3 point : {Vec3{0, -1, 0}, Vec3{2, 1.5, 1}, Vec3{-1, 3, -0.5}}) {
      test::Pose pose(rig);
      pose.move_to(kGoal, model.by * point);
      const Limb limb(pose);
      CHECK(limb.deviation() < 1e-9);
      const Vec3 toward = math::normalised(model.by * point - limb.upper);
      CHECK(math::dot(math::normalised(limb.end - limb.upper), toward) > 1 - 1e-12);
      CHECK(length_error(rig, pose) < 1e-9);
    }
  }
}

TEST_CASE("modules ik: a goal too near folds the limb and breaks nothing") {
  const test::Rig rig(bent());
  for (const Vec3 point : {Vec3{0, 1, 0}, Vec3{0, 0.99, 0.01}, Vec3{0.05, 1, 0}}) {
    test::Pose pose(rig);
    pose.move_to(kGoal, point);
    CHECK(length_error(rig, pose) < 1e-9);
    CHECK(std::isfinite(Limb(pose).end.x));
  }
}

TEST_CASE("modules ik: the same goal is the same motion on every model") {
  const auto reach = [](const test::Rig& rig, const math::Affine& by, Vec3 point) {
    test::Pose pose(rig);
    pose.turn_in_world("base/control", test::mapped(by, math::from_euler_degrees({0, 20, 5})));
    pose.move_to(kGoal, by * point);
    return test::motion(rig, pose);
  };
  for (const std::string& text : {bent(), straight(", bend: forward")}) {
    const test::Rig plain(text);
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      const test::Rig rig(text, model.change);
      for (const Vec3 point : {Vec3{0.2, 0.4, 0.3}, Vec3{0, 0.3, 0}, Vec3{-0.4, 1.2, 0.1}}) {
        CHECK(test::motion_difference(rig, reach(rig, model.by, point),
                                      test::mapped(model.by, reach(plain, {}, point))) < 1e-7);
      }
    }
  }
}

TEST_CASE("modules ik: a straight limb bends to the stated side") {
  const std::map<std::string, Vec3> sides{{"forward", {0, 0, 1}},
                                          {"backward", {0, 0, -1}},
                                          {"left", {1, 0, 0}},
                                          {"right", {-1, 0, 0}},
                                          {"auto", {0, 0, 1}}};
  for (const auto& row : sides) {
    const std::string side = row.first;
    const Vec3 direction = row.second;
    CAPTURE(side);
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      const test::Rig rig(straight(", bend: " + side), model.change);
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
      test::Pose pose(rig);
      pose.move_to(kGoal, model.by * Vec3{0, 0.4, 0});
      const Limb limb(pose);
      const Vec3 out =
          math::normalised(limb.lower - limb.upper) - math::normalised(limb.end - limb.upper);
      CHECK(math::dot(math::normalised(out), math::normalised(model.by.linear * direction)) > 0.9);
    }
  }
}

TEST_CASE("modules ik: a limb bent by less than 5 degrees does not flip its frame") {
  // The same knee with noise of +-2 mm must bend forward either way, and turn its frames alike.
  const auto noisy = [](const char* middle) {
    return test::limb(
        "[0, 1, 0]", middle, "[0, 0.1, 0]",
        {{"base", "{command: control, with: {}}"}, {"end", handle(", bend: forward")}});
  };
  const test::Rig front(noisy("[0, 0.5, 0.002]"));
  const test::Rig back(noisy("[0, 0.5, -0.002]"));
  const test::Rig side(noisy("[0.002, 0.5, 0]"));
  const auto knee = [](const test::Rig& rig) {
    test::Pose pose(rig);
    pose.move_to(kGoal, {0, 0.4, 0});
    return pose.position("limb.lower");
  };
  CHECK(test::distance(knee(front), knee(back)) < 0.02);
  CHECK(knee(side).z > 0.2);
  CHECK(knee(back).z > 0.2);
  for (const test::Rig* rig : {&front, &back, &side}) CHECK(test::rest_error(*rig) < 1e-9);
}

TEST_CASE("modules ik: a nearly straight limb rests where it is, bent to any side") {
  // Knees up to 4.9 degrees off straight, on every side; the more it bends, the more it bends
  // forward, with no jump on the way, and its thigh does not spin about itself.
  test::Random random(23);
  for (int i = 0; i < 40; ++i) {
    const double side = random.number(-180, 180), out = 0.45 * random.number(1e-5, 0.042);
    CAPTURE(side);
    CAPTURE(out);
    const std::string middle =
        fmt::format("[{}, 0.5, {}]", out * math::sin_degrees(side), out * math::cos_degrees(side));
    const test::Rig rig(
        test::limb("[0, 1, 0]", middle, "[0, 0.1, 0]",
                   {{"base", "{command: control, with: {}}"}, {"end", handle(", bend: forward")}}));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    double jump = 0, spin = 0;
    std::vector<math::Affine> last = test::Pose(rig).joints();
    for (double y = 0.1; y < 0.45; y += 0.0005) {
      test::Pose pose(rig);
      pose.move_to(kGoal, {0, y, 0});
      CHECK(test::distance(pose.position("limb.end"), {0, y, 0}) < 1e-9);
      const auto joints = pose.joints();
      for (std::size_t k = 0; k < joints.size(); ++k)
        jump = std::max(jump, test::distance(joints[k].origin, last[k].origin));
      const Vec3 toes = pose.world("limb.upper").linear *
                        math::transposed(rig.rest("limb.upper").linear) * Vec3{0, 0, 1};
      spin = std::max(
          spin, std::abs(math::degrees(math::atan2(toes.x, math::length({0, toes.y, toes.z})))));
      last = joints;
    }
    CHECK(jump < 0.04);
    CHECK(spin < 20);
    const bool agrees = std::abs(side) < 60;
    CHECK(last[2].origin.z > (agrees ? 0.1 : 0.3));
  }
}

TEST_CASE("modules ik: the pole decides the plane") {
  const std::string text =
      test::limb("[0, 1, 0]", "[0, 0.51, 0.1]", "[0, 0.12, 0.02]",
                 {{"base", "{command: control, with: {}}"},
                  {"lower", "{command: control, with: {drive: off, parent: base/control}}"},
                  {"end", handle(", pole: limb.lower/control")}});
  const test::Rig rig(text);
  REQUIRE(rig.clean());
  for (const Vec3 pole : {Vec3{1, 0.5, 0}, Vec3{-1, 0.5, 0.2}, Vec3{0, 0.5, -1}}) {
    test::Pose pose(rig);
    pose.move_to("limb.lower/control", pole).move_to(kGoal, {0.1, 0.4, 0.1});
    const Limb limb(pose);
    const Vec3 along = math::normalised(limb.end - limb.upper);
    const auto across = [&](Vec3 v) { return math::normalised(v - along * math::dot(v, along)); };
    CHECK(math::dot(across(limb.lower - limb.upper), across(pole - limb.upper)) > 1 - 1e-9);
  }
}

TEST_CASE("modules ik: twist turns the bend about the line to the goal") {
  const test::Rig rig(bent(", twist: 90"));
  test::Pose pose(rig);
  pose.move_to(kGoal, {0, 0.4, 0});
  const Limb limb(pose);
  CHECK(std::abs(limb.lower.x) > 0.2);
  CHECK(std::abs(limb.lower.z) < 1e-3);
}

TEST_CASE("modules ik: without a goal the handle itself is moved, under the root") {
  const test::Rig rig(
      test::limb("[0, 1, 0]", "[0, 0.51, 0.1]", "[0, 0.12, 0.02]",
                 {{"base", "{command: root, with: {drive: on}}"},
                  {"upper", "{command: ik_handle, with: {start: ., end: limb.end}}"}}));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  pose.move_to("limb.end/ik_handle.handle", {0, 0.32, 0.12});
  CHECK(test::distance(pose.position("limb.end"), {0, 0.32, 0.12}) < 1e-5);
}

TEST_CASE("modules ik: a straight chain bends to the stated side, on every model") {
  const std::string goal = "tail[0]/control#goal";
  for (const auto& row : std::map<std::string, Vec3>{{"up", {0, 1, 0}}, {"left", {1, 0, 0}}}) {
    const std::string text = test::tail(
        6, {{"base", "{command: control, with: {}}"},
            {"tail",
             "{command: control, id: goal, with: {drive: off, parent: base/control}}\n"
             "{command: ik_handle, with: {solver: chain, start: \"tail[0]\", end: \"tail[END]\", "
             "goal: \"./control#goal\", bend: " +
                 row.first + "}}"}});
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      const test::Rig rig(text, model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
      test::Pose pose(rig);
      pose.move_to(goal, pose.position(goal) + model.by.linear * Vec3{0, 0, 0.4});
      const Vec3 middle = pose.position("tail[3]") - pose.position("tail[0]");
      const Vec3 out = model.by.linear * row.second;
      CHECK(math::dot(middle, out) > 0.05 * math::dot(out, out));
      CHECK(length_error(rig, pose) < 1e-9);
    }
  }
}

TEST_CASE("modules ik: the chain solver reaches with any number of joints") {
  const test::Commands commands{
      {"base", "{command: control, with: {}}"},
      {"tail",
       "{command: control, id: goal, with: {drive: off, parent: base/control}}\n"
       "{command: ik_handle, with: {solver: chain, start: \"tail[0]\", end: \"tail[END]\", "
       "goal: \"./control#goal\", iterations: 60}}"}};
  for (const int count : {2, 3, 5, 8}) {
    CAPTURE(count);
    const test::Rig rig(test::tail(count, commands));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose pose(rig);
    pose.translate("tail[0]/control#goal", {0.3, 0.2, 0.4});
    CHECK(test::largest_difference(test::bone_lengths(rig, pose.joints()),
                                   test::bone_lengths(rig, test::Pose(rig).joints())) < 1e-9);
    if (count > 3) {
      CHECK(test::distance(pose.position("tail[END]"), {0.3, 1.2, -0.6}) < 1e-3);
    }
    // Out of reach it is straight.
    pose.translate("tail[0]/control#goal", {0, 3, 0});
    const Vec3 start = pose.position("tail[0]"), end = pose.position("tail[END]");
    for (int i = 0; i < count; ++i) {
      const Vec3 at = pose.position("tail[" + std::to_string(i) + "]");
      CHECK(math::length(math::cross(math::normalised(end - start), at - start)) < 1e-6);
    }
  }
}

TEST_CASE("modules ik: roll joints and scaled joints in a limb change neither reach nor lengths") {
  const test::Rig plain(bent());
  const std::map<std::string, test::Rig::Change> changes{
      {"roll joints",
       [](auto& s) {
         test::put_between(s, "lower", 1);
         test::put_between(s, "end", 1);
         test::put_between(s, "end", 1);
       }},
      {"scaled roll joints",
       [](auto& s) {
         test::put_between(s, "lower", 3);
         test::put_between(s, "end", 0.2);
       }},
      {"scaled joints",
       [](auto& s) {
         test::scale_below(s, "upper", 2);
         test::scale_below(s, "lower", 0.01);
         test::scale_below(s, "end", 7);
       }},
      {"mirrored joints",
       [](auto& s) {
         test::scale_below(s, "upper", -1);
         test::put_between(s, "lower", 1);
         test::scale_below(s, "lower", -2);
       }},
      {"mirrored first joint", [](auto& s) { test::scale_below(s, "upper", -1); }},
      {"mirrored roll joint", [](auto& s) { test::put_between(s, "lower", -1); }}};
  for (const auto& row : changes) {
    CAPTURE(row.first);
    const test::Rig rig(bent(), row.second);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    for (const Vec3 point : reachable()) {
      test::Pose pose(rig), expected(plain);
      pose.turn_in_world("base/control", math::from_euler_degrees({0, 20, 5}));
      expected.turn_in_world("base/control", math::from_euler_degrees({0, 20, 5}));
      pose.move_to(kGoal, point);
      expected.move_to(kGoal, point);
      const Limb is(pose), wanted(expected);
      CHECK(test::distance(is.lower, wanted.lower) < 1e-9);
      CHECK(test::distance(is.end, wanted.end) < 1e-9);
      CHECK(length_error(rig, pose) < 1e-9);
    }
  }
}

TEST_CASE(
    "modules ik: where the template names no joint between start and end, the one there bends") {
  const test::Rig rig(test::template_of(R"(joints:
  - {name: upper, at: [0, 1, 0], local: limb, label: upper}
  - {name: lower, parent: upper, at: [0, 0.51, 0.1]}
  - name: end
    parent: lower
    at: [0, 0.12, 0.02]
    local: limb
    label: end
    tags:
      - {command: ik_handle, with: {start: limb.upper, end: .}}
)"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.translate("limb.end/ik_handle.handle", {0.2, 0.4, 0.2});
  CHECK(test::distance(pose.position("limb.end"), {0.2, 0.4, 0.2}) < 1e-9);
}

TEST_CASE("modules ik: a chain with scaled joints reaches, at the lengths that it has") {
  const std::string text = test::tail(
      6, {{"base", "{command: control, with: {}}"},
          {"tail",
           "{command: control, id: goal, with: {drive: off, parent: base/control}}\n"
           "{command: ik_handle, with: {solver: chain, start: \"tail[0]\", end: \"tail[END]\", "
           "goal: \"./control#goal\", bend: up, iterations: 60}}"}});
  const test::Rig rig(text, [](auto& s) {
    test::scale_below(s, "tail_1", 0.5);
    test::scale_below(s, "tail_3", 3);
    test::put_between(s, "tail_4", 2);
  });
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  for (const Vec3 move : {Vec3{0.3, 0.2, 0.4}, Vec3{0, 0, 0.3}, Vec3{-0.4, 0.5, 0.6}}) {
    test::Pose pose(rig);
    const Vec3 point = rig.rest("tail[END]").origin + move;
    pose.translate("tail[0]/control#goal", move);
    CHECK(test::distance(pose.position("tail[END]"), point) < 1e-3);
    CHECK(length_error(rig, pose) < 1e-9);
  }
}
