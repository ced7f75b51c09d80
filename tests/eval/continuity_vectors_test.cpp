// SPDX-License-Identifier: MIT
// Formulas over vectors and rotations do not jump but where no rule could help it: arguments that
// move smoothly past their singular lines, every step bounded by the argument's step times
// 1 / (distance from the line), and the jumps that are inherent, with their size.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"
#include "tests/eval/sweep.h"

namespace rigc {
namespace {

using eval::Op;
using math::Quat;
using math::Vec3;
using scene::Value;
using test::kTurn;
using test::on_circle;

Value result(Op op, scene::Type type, const test::Arguments& arguments) {
  const auto width = static_cast<std::uint32_t>(scene::width(type));
  return eval::value_from(type, test::run_kernel_once(op, arguments, {}, width).data());
}
Quat rotation(Op op, const test::Arguments& arguments) {
  return std::get<Quat>(result(op, scene::Type::quat, arguments));
}
double twist(const Quat& q, Vec3 axis) {
  return std::get<double>(result(Op::twist_angle, scene::Type::number, {q, axis}));
}

// A result at time 0..1.
using Moving = std::function<Value(double time)>;

double largest_step(int frames, const Moving& result) {
  Value before = result(0);
  double most = 0;
  for (int i = 1; i < frames; ++i) {
    const Value next = result(static_cast<double>(i) / (frames - 1));
    most = std::fmax(most, test::step_of(before, next));
    before = next;
  }
  return most;
}

// No step is larger than `rate` times the step of time, for coarse and for fine frames.
void check_rate(double rate, const Moving& result) {
  for (const int frames : {1001, 20001}) {
    CAPTURE(frames);
    const double largest = largest_step(frames, result);
    CHECK(largest <= rate / (frames - 1));
    CHECK(largest > 0);
  }
}

Quat about_z(double degrees) { return math::from_euler_degrees({0, 0, degrees}); }

TEST_CASE("eval continuity: slerp by its part, however far apart") {
  for (const double apart : {1e-7, 10.0, 179.999, 180.0, 180.001, 350.0}) {
    const double nearer = math::radians(std::fmin(apart, 360 - apart));
    check_rate(1.001 * nearer, [&](double t) {
      return rotation(Op::rotation_slerp, {Quat{}, about_z(apart), t});
    });
  }
}

// From a quarter of half a turn one way to a quarter the other way.
TEST_CASE("eval continuity: slerp past half a turn jumps by twice its part") {
  const auto at = [](double degrees) {
    return rotation(Op::rotation_slerp, {Quat{}, about_z(degrees), 0.25});
  };
  const Quat jump = math::conjugate(at(180.1)) * at(179.9);
  CHECK(math::degrees(2 * math::acos(jump.w)) == doctest::Approx(90).epsilon(1e-2));
}

TEST_CASE("eval continuity: between, a direction that passes the opposite of the other") {
  for (const double past : {1.0, 0.1, 0.01, 1e-4}) {
    check_rate(2.2 * kTurn / past, [&](double t) {
      return rotation(Op::between, {Vec3{1, 0, 0}, on_circle(t) + Vec3{0, 0, past}});
    });
  }
  // Around the direction itself nothing is steep.
  check_rate(1.1 * kTurn, [](double t) {
    return rotation(Op::between, {Vec3{1, 0, 0}, Vec3{1, 0, 0} + on_circle(t) * 0.5});
  });
}

TEST_CASE("eval continuity: aim, a secondary that passes the primary and its opposite") {
  for (const double past : {1.0, 0.1, 0.01, 1e-4}) {
    check_rate(1.1 * kTurn / past, [&](double t) {
      return rotation(Op::aim_rotation, {Vec3{2, 0, 0}, on_circle(t) + Vec3{0, 0, past}});
    });
  }
}

// As a point on a circle: 180 and -180 are one angle.
TEST_CASE("eval continuity: twist, a swing that passes half a turn at a distance") {
  for (const double past : {0.5, 0.05, 1e-3}) {
    check_rate(2.1 * 2 / past, [&](double t) {
      const double half_swing = math::kPi / 2 + 2 * t - 1;
      const Quat q{past, 0, math::sin(half_swing), math::cos(half_swing)};
      return on_circle(twist(q, {1, 0, 0}) / 360);
    });
  }
}

TEST_CASE("eval continuity: twist, a turn about the axis after a swing") {
  check_rate(359.001, [](double t) {
    const Quat turned = math::axis_angle({1, 0, 0}, math::radians(359 * t - 179.5));
    return twist(about_z(120) * turned, {1, 0, 0});
  });
}

TEST_CASE("eval continuity: the rotation of a matrix while a column shrinks to nothing") {
  const Quat turned = math::from_euler_degrees({20, -50, 100});
  for (const double left : {1.0, 1e-6, 1e-25, 1e-33, 0.0}) {
    for (const Vec3 scale : {Vec3{2 * left, 3, 4}, {2, 3 * left, 4}, {2, 3, 4 * left}}) {
      const math::Affine shrunk = math::compose({{}, turned, scale});
      CHECK(test::step_of(rotation(Op::matrix_rotation, {shrunk}), turned) < 1e-14);
    }
  }
}

}  // namespace
}  // namespace rigc
