// SPDX-License-Identifier: MIT
// Joints of IK do not jump: for inputs that move smoothly every step from frame to frame is bounded
// by the input's step times a constant that is stated, also for finer and finer frames. Where an
// answer has a singular line the bound grows with 1 / (distance from it) and the frame on the line
// itself shows what is defined there. Where bones straighten, joints move with the square root of
// what is left.
#include <doctest/doctest.h>

#include "tests/eval/sweep.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using scene::Value;
using test::check_steps;
using test::kTurn;
using test::on_circle;
using test::Sweep;
namespace transform = scene::transform;

// Two bones.

TEST_CASE("eval continuity: two bones, the goal through full extension and far beyond") {
  const test::LimbScene limb;
  const Sweep sweep = limb.sweep({limb.goal_at()});
  // A knee of two bones of length 1 is sqrt(left) high: steps below 1.5 sqrt(step).
  check_steps(
      sweep,
      [](double t) {
        return std::vector<Value>{Vec3{1 + 2 * t, 0, 0}};
      },
      [](double h) { return 1.5 * std::sqrt(2 * h); });
  check_steps(
      sweep,
      [](double t) {
        return std::vector<Value>{Vec3{1 + 2 * t, -1 + 2 * t, 0.3}};
      },
      [](double h) { return 1.5 * std::sqrt(3 * h); });
  // Beyond, the limb turns with the goal and nothing else.
  check_steps(
      sweep, [](double t) { return std::vector<Value>{on_circle(0.4 * t - 0.2) * 5.0}; },
      [](double h) { return 2.3 * 0.4 * kTurn * h; });
}

TEST_CASE("eval continuity: two bones, the goal through where they fold") {
  // Bones of 1.2 and 0.8 reach no nearer than 0.4.
  const test::LimbScene limb(1.2, 0.8);
  check_steps(
      limb.sweep({limb.goal_at()}),
      [](double t) {
        return std::vector<Value>{Vec3{1 - 0.9 * t, 0, 0}};
      },
      [](double h) { return 5 * std::sqrt(h); });
}

TEST_CASE("eval continuity: two bones, the goal past the root: turns by step / distance") {
  for (const double lower : {1.0, 0.7}) {
    const test::LimbScene limb(1, lower);
    const Sweep sweep = limb.sweep({limb.goal_at()});
    for (const double past : {0.5, 0.1, 0.02}) {
      check_steps(
          sweep,
          [&](double t) {
            return std::vector<Value>{Vec3{2 * t - 1, 0, past}};
          },
          [&](double h) { return 5 * 2 * h / past + 5 * std::sqrt(h) * (lower < 1); });
    }
  }
}

TEST_CASE("eval continuity: two bones, half turns of the goal, behind the root too") {
  const test::LimbScene limb;
  check_steps(
      limb.sweep({limb.goal_at()}),
      [](double t) {
        const Vec3 c = on_circle(t) * 1.4;
        return std::vector<Value>{Vec3{c.x, 0.3, c.y}};
      },
      [](double h) { return 2.2 * 1.4 * kTurn * h; });
}

TEST_CASE("eval continuity: two bones, pole and goal past their line: step / distance from it") {
  const test::LimbScene limb;
  for (const double past : {0.5, 0.1, 0.01, 1e-3, 2e-5}) {
    check_steps(
        limb.sweep({limb.pole_at()}),
        [&](double t) {
          return std::vector<Value>{Vec3{1, 2 * t - 1, past}};
        },
        [&](double h) { return 1.5 * 2 * h / past; });
    check_steps(
        limb.sweep({limb.goal_at()}),
        [&](double t) {
          return std::vector<Value>{Vec3{2 * t - 1, 1, past}};
        },
        [&](double h) { return 1.5 * 2 * h / past; });
  }
}

// The plane turns over where the pole crosses the line. That is inherent: the same pole distance on
// both sides bends the limb to opposite sides. On the line the plane of rest counts.
TEST_CASE("eval continuity: two bones, the pole through its line") {
  const test::LimbScene limb;
  const Sweep sweep = limb.sweep({limb.pole_at()});
  const auto frames = sweep.run(3, [](double t) {
    return std::vector<Value>{Vec3{1, 2 * t - 1, 0}};
  });
  const auto knee = [&](std::size_t frame) { return std::get<Affine>(frames[frame][1]).origin; };
  CHECK(knee(0).y < -0.5);
  CHECK(knee(2).y > 0.5);
  CHECK(test::distance(knee(1), knee(2)) < 1e-14);
}

TEST_CASE("eval continuity: two bones, twist turns evenly through whole turns") {
  const test::LimbScene limb;
  check_steps(
      limb.sweep({{limb.limb, scene::ik2::kTwist}}),
      [](double t) { return std::vector<Value>{720 * t - 360}; },
      [](double h) { return 1.5 * 2 * kTurn * h; });
}

TEST_CASE("eval continuity: two bones, turns of the base about its start move nothing") {
  const test::LimbScene limb;
  const Sweep sweep = limb.sweep({{limb.base, transform::kRotation}});
  const Vec3 axis = math::normalised(Vec3{1, 2, 3});
  const double largest = sweep.largest_step(
      1001, [&](double t) { return std::vector<Value>{math::axis_angle(axis, kTurn * t)}; });
  CHECK(largest < 1e-14);
}

// Anywhere: what moves by a little moves all by little, however the limb stands.
TEST_CASE("eval continuity: two bones, small steps anywhere") {
  const test::LimbScene limb(1.1, 0.9);
  const Sweep sweep = limb.sweep({limb.goal_at(), limb.pole_at(), {limb.limb, scene::ik2::kTwist}});
  test::Random random(5);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 goal = random.arrow(0.3, 2.5), pole = random.arrow(0.5, 4);
    const double step = std::ldexp(1.0, -static_cast<int>(10 + random.below(20)));
    const Vec3 by = random.direction() * step, pole_by = random.direction() * step;
    const auto frames = sweep.run(2, [&](double t) {
      return std::vector<Value>{goal + by * t, pole + pole_by * t, 90 + t * step};
    });
    const double size = math::length(goal), far = math::length(pole);
    const double aside =
        math::length(math::cross(goal * (1 / size), pole * (1 / far)));  // from the singular line
    const double bent = std::fmin(std::fabs(2 - size), std::fabs(0.2 - size));
    const double knee = std::fmax(std::sqrt(std::fmax(bent - 2 * step, 0)), std::sqrt(step));
    if (aside < 4 * step) continue;
    const double bound = step * (1 + 1 / knee + (1 / size + 1 / far) / aside);
    CHECK(test::step_of(frames[0], frames[1]) <= 3 * bound);
  }
}

// Chains of four bones.

TEST_CASE("eval continuity: chain, goals around a bent one: six times the goal's step") {
  for (const double bend : {30.0, 80.0}) {
    for (const bool has_pole : {false, true}) {
      CAPTURE(bend);
      CAPTURE(has_pole);
      const test::ChainScene chain(4, bend, has_pole);
      const Sweep sweep = chain.sweep({chain.goal_at()});
      for (const double radius : {1.0, 3.0}) {
        check_steps(
            sweep, [&](double t) { return std::vector<Value>{on_circle(0.4 * t - 0.2) * radius}; },
            [](double h) { return 6 * 0.4 * kTurn * 3 * h; });
      }
      check_steps(
          sweep,
          [](double t) {
            return std::vector<Value>{Vec3{0.5 + 3 * t, 0, 0}};
          },
          [](double h) { return 6 * 3 * h; });
      check_steps(
          sweep,
          [](double t) {
            const Vec3 c = on_circle(0.8 * t - 0.4) * 3.0;
            return std::vector<Value>{Vec3{c.x, 0.1, c.y}};
          },
          [](double h) { return 6 * 0.8 * kTurn * 3 * h; });
    }
  }
}

TEST_CASE("eval continuity: chain, beyond its reach it turns with the goal") {
  const test::ChainScene chain(4, 30, false);
  check_steps(
      chain.sweep({chain.goal_at()}),
      [](double t) { return std::vector<Value>{on_circle(0.4 * t - 0.2) * 5.0}; },
      [](double h) { return 5 * 0.4 * kTurn * h; });
}

TEST_CASE("eval continuity: chain, the goal through full extension") {
  for (const double bend : {0.0, 5.0, 30.0, 80.0}) {
    CAPTURE(bend);
    const test::ChainScene chain(4, bend, true);
    check_steps(
        chain.sweep({chain.goal_at()}),
        [](double t) {
          return std::vector<Value>{Vec3{3 + 2 * t, 0, 0}};
        },
        [](double h) { return 4 * std::sqrt(2 * h); });
  }
}
TEST_CASE("eval continuity: chain, one that is little bent at rest") {
  const test::ChainScene chain(4, 10, true);
  check_steps(
      chain.sweep({chain.goal_at()}),
      [](double t) {
        return std::vector<Value>{Vec3{1.5 + 1.7 * t, 0, 0}};
      },
      [](double h) { return 6 * 1.7 * h; });
}

TEST_CASE("eval continuity: chain, a straight one without a pole") {
  const test::ChainScene chain(4, 0, false);
  check_steps(
      chain.sweep({chain.goal_at()}),
      [](double t) { return std::vector<Value>{on_circle(0.4 * t - 0.2) * 3.0}; },
      [](double h) { return 6 * 0.4 * kTurn * 3 * h; });
}

}  // namespace
}  // namespace rigc
