// SPDX-License-Identifier: MIT
// Joints do not jump: for inputs that move smoothly every step from frame to frame is bounded by
// the input's step times a constant that is stated, also for finer and finer frames. Where an
// answer has a singular line the bound grows with 1 / (distance from it) and the frame on the line
// itself shows what is defined there.
#include <doctest/doctest.h>

#include "tests/eval/sweep.h"

namespace rigc {
namespace {

using math::Affine;
using math::Quat;
using math::Vec3;
using scene::NodeId;
using scene::Plug;
using scene::Value;
using test::check_steps;
using test::kTurn;
using test::on_circle;
using test::SceneBuilder;
using test::Sweep;
namespace transform = scene::transform;

Quat about_z(double degrees) { return math::from_euler_degrees({0, 0, degrees}); }

struct AimScene : SceneBuilder {
  NodeId target = transform("target"), up = transform("up"), other = transform("other"),
         aim = make(scene::Kind::aim_constraint, "aim");
  explicit AimScene(double mode) {
    namespace at = scene::aim;
    edit.set({aim, at::kUpMode}, mode);
    edit.set({aim, at::kUpVector}, Vec3{0, 1, 0});
    edit.set({target, transform::kTranslate}, Vec3{2, 0, 0});
    edit.set({other, transform::kTranslate}, Vec3{0, 0, 2});
    edit.connect({up, transform::kWorld}, {aim, at::kUpTarget});
    edit.connect({target, transform::kWorld}, {aim, at::kTargets, 0});
    edit.connect({other, transform::kWorld}, {aim, at::kTargets, 1});
    edit.set({aim, at::kWeights, 0}, 1.0);
    edit.set({aim, at::kWeights, 1}, 0.0);
  }
  Plug target_at() const { return {target, transform::kTranslate}; }
  Sweep sweep(const Plug& input) const { return {scene, {input}, {{aim, scene::aim::kRotation}}}; }
};

TEST_CASE("eval continuity: aim, the target past the node: turns by step / distance") {
  const AimScene aim(0);
  for (const double past : {1.0, 0.1, 0.01, 1e-4}) {
    check_steps(
        aim.sweep(aim.target_at()),
        [&](double t) {
          return std::vector<Value>{Vec3{2 * t - 1, 0, past}};
        },
        [&](double h) { return 1.1 * 2 * h / past; });
  }
}

TEST_CASE("eval continuity: aim, the target past the line of up: step / distance from it") {
  const AimScene aim(0);
  for (const double past : {1.0, 0.1, 0.01, 1e-4}) {
    check_steps(
        aim.sweep(aim.target_at()),
        [&](double t) {
          return std::vector<Value>{Vec3{2 * t - 1, 1, past}};
        },
        [&](double h) { return 1.5 * 2 * h / past; });
  }
}

TEST_CASE("eval continuity: aim, up that turns through the line and up targets that pass it") {
  const AimScene vector(0), point(1), turned(2);
  for (const double past : {0.5, 0.05, 1e-3}) {
    const auto bound = [&](double h) { return 1.5 * kTurn * h / past; };
    check_steps(
        vector.sweep({vector.aim, scene::aim::kUpVector}),
        [&](double t) {
          return std::vector<Value>{on_circle(t) + Vec3{0, 0, past}};
        },
        bound);
    check_steps(
        point.sweep({point.up, transform::kTranslate}),
        [&](double t) {
          return std::vector<Value>{on_circle(t) * 2.0 + Vec3{0, 0, 2 * past}};
        },
        bound);
  }
  check_steps(
      turned.sweep({turned.up, transform::kRotation}),
      [](double t) {
        return std::vector<Value>{math::from_euler_degrees({360 * t, 0, 0})};
      },
      [](double h) { return 1.1 * kTurn * h; });
}

// Where the target crosses the node the line turns round: on the node itself the parent's x counts.
TEST_CASE("eval continuity: aim, the target through the node") {
  const AimScene aim(0);
  const auto frames = aim.sweep(aim.target_at()).run(3, [](double t) {
    return std::vector<Value>{Vec3{0, 0, 2 * t - 1}};
  });
  const auto along = [&](std::size_t i) {
    return math::rotate(std::get<Quat>(frames[i][0]), Vec3{1, 0, 0});
  };
  CHECK(test::distance(along(0), Vec3{0, 0, -1}) < 1e-15);
  CHECK(test::distance(along(1), Vec3{1, 0, 0}) < 1e-15);
  CHECK(test::distance(along(2), Vec3{0, 0, 1}) < 1e-15);
}

TEST_CASE("eval continuity: aim, from one target to another by weight") {
  const AimScene aim(0);
  check_steps(
      aim.sweep({aim.aim, scene::aim::kWeights, 1}), [](double t) { return std::vector<Value>{t}; },
      [](double h) { return 2 * h; });
}

struct ConstraintScene : SceneBuilder {
  NodeId first = transform("first"), second = transform("second"),
         driven = make(scene::Kind::parent_constraint, "driven");
  ConstraintScene() {
    namespace at = scene::constraint;
    edit.connect({first, transform::kWorld}, {driven, at::kTargets, 0});
    edit.connect({second, transform::kWorld}, {driven, at::kTargets, 1});
    for (const std::int32_t i : {0, 1}) {
      edit.set({driven, at::kWeights, i}, 1.0 - i);
      edit.set({driven, at::kOffsets, i}, Affine{});
    }
  }
  Sweep sweep(const std::vector<Plug>& inputs) const {
    namespace at = scene::constraint;
    return {scene, inputs, {{driven, at::kTranslate}, {driven, at::kRotation}}};
  }
  Plug weight(std::int32_t i) const { return {driven, scene::constraint::kWeights, i}; }
};

TEST_CASE("eval continuity: constraints, weights from one target to another, nearly half a turn") {
  for (const double apart : {10.0, 90.0, 179.0, 179.999999, 180.0, 180.000001, 270.0}) {
    ConstraintScene scene;
    scene.edit.set({scene.second, transform::kRotation}, about_z(apart));
    scene.edit.set({scene.second, transform::kTranslate}, Vec3{2, 0, 0});
    check_steps(
        scene.sweep({scene.weight(0), scene.weight(1)}),
        [](double t) {
          return std::vector<Value>{1 - t, t};
        },
        [](double h) { return 1.001 * kTurn / 2 * h; });
  }
}

TEST_CASE("eval continuity: constraints, a weight that comes from nothing beside others") {
  ConstraintScene scene;
  scene.edit.set({scene.second, transform::kRotation}, about_z(120));
  // The share is weight / sum: a second weight of t beside 1 is steepest at 0.
  check_steps(
      scene.sweep({scene.weight(0), scene.weight(1)}),
      [](double t) {
        return std::vector<Value>{1.0, t};
      },
      [](double h) { return 1.001 * kTurn / 3 * h; });
}

// Half a turn apart both ways are as long. Half way between, the mean flips to the other side where
// the turn passes 180 degrees: inherent, a jump of 2 * weight * 180 degrees.
TEST_CASE("eval continuity: constraints, a target that turns past half a turn") {
  ConstraintScene scene;
  for (const std::int32_t i : {0, 1}) scene.edit.set(scene.weight(i), 1.0);
  const Sweep sweep = scene.sweep({{scene.second, transform::kRotation}});
  const auto turning = [](double from, double to) {
    return [=](double t) { return std::vector<Value>{about_z(from + (to - from) * t)}; };
  };
  const auto half_as_fast = [](double h) { return 0.501 * math::radians(179.9) * h; };
  check_steps(sweep, turning(0, 179.9), half_as_fast);
  check_steps(sweep, turning(180.1, 360), half_as_fast);
  const auto frames = sweep.run(2, turning(179.9, 180.1));
  CHECK(test::step_of(frames[0][1], frames[1][1]) > 2.8);
}

struct LimitScene : SceneBuilder {
  NodeId node = transform("node"), limits = make(scene::Kind::limits, "limits");
  explicit LimitScene(const std::vector<double>& bounds) {
    edit.connect({node, transform::kWorld}, {limits, scene::limits::kNode});
    edit.set({limits, scene::limits::kBounds}, bounds);
    edit.set({limits, scene::limits::kOrder}, std::string("xyz"));
  }
  Sweep sweep(std::uint16_t attribute) const {
    return {scene, {{node, attribute}}, {{node, transform::kWorld}}};
  }
};

TEST_CASE("eval continuity: limits, values that enter and leave their bounds") {
  const LimitScene places({0, 0, -0.5, 0, 1, 0.5, 1, 1, 0.2});
  check_steps(
      places.sweep(transform::kTranslate),
      [](double t) { return std::vector<Value>{on_circle(t)}; },
      [](double h) { return 1.001 * kTurn * h; });
  const LimitScene angle({5, 0, -30, 5, 1, 45});
  check_steps(
      angle.sweep(transform::kRotation),
      [](double t) { return std::vector<Value>{about_z(351 * t - 172)}; },
      [](double h) { return 1.001 * math::radians(351) * h; });
  // Swings within 70 degrees, each axis bounded.
  const LimitScene ball({3, 0, -20, 3, 1, 30, 4, 0, -15, 4, 1, 40, 5, 0, -50, 5, 1, 10});
  check_steps(
      ball.sweep(transform::kRotation),
      [](double t) {
        return std::vector<Value>{math::axis_angle(on_circle(t), 1.2 * math::sin(3 * kTurn * t))};
      },
      [](double h) { return 4 * 1.2 * 3 * kTurn * h; });
}

// Half a turn from the middle of the bounds both bounds are as near: inherent. One of them is
// chosen, the same for the same input.
TEST_CASE("eval continuity: limits, half a turn off") {
  const LimitScene angle({5, 0, -30, 5, 1, 30});
  const auto frames = angle.sweep(transform::kRotation).run(3, [](double t) {
    return std::vector<Value>{about_z(179.9 + 0.2 * t)};
  });
  const auto angle_at = [&](std::size_t i) {
    const Vec3 x = std::get<Affine>(frames[i][0]).linear.x;
    return math::degrees(math::atan2(x.y, x.x));
  };
  CHECK(angle_at(0) == doctest::Approx(30));
  CHECK(angle_at(1) == doctest::Approx(30));
  CHECK(angle_at(2) == doctest::Approx(-30));
}

TEST_CASE("eval continuity: remap, smooth curves pass their points and their ends smoothly") {
  for (const double interpolation : {1.0, 2.0, 3.0}) {
    for (const double clamp : {0.0, 1.0}) {
      SceneBuilder b;
      const NodeId curve = b.make(scene::Kind::remap, "curve");
      b.edit.set({curve, scene::remap::kPoints},
                 std::vector<double>{0, 0, interpolation, 0.25, 1, interpolation, 0.75, 0.5,
                                     interpolation, 1, 2, interpolation});
      b.edit.set({curve, scene::remap::kClamp}, clamp);
      const Sweep sweep(b.scene, {{curve, scene::remap::kInput}}, {{curve, scene::remap::kOutput}});
      // The steepest segment rises by 6; eased in and out it is half as steep again, and a monotone
      // cubic at most twice more.
      check_steps(
          sweep, [](double t) { return std::vector<Value>{2 * t - 0.5}; },
          [](double h) { return 6 * 3 * 2 * h; });
    }
  }
}

}  // namespace
}  // namespace rigc
