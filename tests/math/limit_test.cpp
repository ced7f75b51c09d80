// SPDX-License-Identifier: MIT
// Clamping along and about axes: what is inside stays to the last bit, what comes out is inside.
#include "math/limit.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/math/random.h"

using namespace rigc;
using math::LimitSpace;
using math::Quat;
using math::Vec3;

namespace {

double angle(const Quat& a, const Quat& b) {
  return math::degrees(2 * math::acos(std::fmin(1, std::fabs(math::dot(a, b)))));
}

LimitSpace about(std::size_t axis, double min, double max) {
  LimitSpace space;
  space.min[axis] = min;
  space.max[axis] = max;
  return space;
}

Vec3 limited(Vec3 degrees, const LimitSpace& space) {
  return math::to_euler_degrees(math::limit_rotation(math::from_euler_degrees(degrees), space));
}

bool near(Vec3 a, Vec3 b) { return math::length(a - b) < 1e-9; }

}  // namespace

TEST_CASE("math limit: nothing is bounded at first, and everything comes back to the last bit") {
  test::Random random(1);
  const LimitSpace none;
  CHECK_FALSE(none.bounded());
  for (int i = 0; i < 200; ++i) {
    const math::Trs trs = random.trs();
    CHECK(math::limit_vector(trs.translation, none) == trs.translation);
    CHECK(math::limit_rotation(trs.rotation, none) == trs.rotation);
  }
}

TEST_CASE("math limit: a vector is clamped along its axes, the other axes stay") {
  LimitSpace space = about(1, -1, 2);
  CHECK(space.bounded());
  CHECK(math::limit_vector({7, 3, -9}, space) == Vec3{7, 2, -9});
  CHECK(math::limit_vector({7, -3, -9}, space) == Vec3{7, -1, -9});
  CHECK(math::limit_vector({7, 0.3, -9}, space) == Vec3{7, 0.3, -9});
  space.origin = {0, 10, 0};
  CHECK(math::limit_vector({7, 3, -9}, space) == Vec3{7, 9, -9});
  space.axes = math::from_euler_degrees({0, 0, 90});  // its y points along -x
  CHECK(near(math::limit_vector({7, 3, -9}, space), {1, 3, -9}));
}

TEST_CASE("math limit: an angle stops at its bound, also beyond 90 degrees of the middle axis") {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    for (double turn = -170; turn <= 170; turn += 5) {
      Vec3 degrees;
      degrees[axis] = turn;
      const Quat value = math::from_euler_degrees(degrees);
      Vec3 expected;
      expected[axis] = std::fmin(130, std::fmax(-120, turn));
      const Quat got = math::limit_rotation(value, about(axis, -120, 130));
      CHECK(angle(got, math::from_euler_degrees(expected)) < 1e-5);
      // A bound of another axis does not care.
      CHECK(math::limit_rotation(value, about((axis + 1) % 3, -10, 10)) == value);
    }
  }
}

TEST_CASE("math limit: one side alone bounds that side") {
  LimitSpace space;
  space.max.x = 90;
  CHECK(near(limited({100, 0, 0}, space), {90, 0, 0}));
  CHECK(near(limited({-170, 0, 0}, space), {-170, 0, 0}));
}

TEST_CASE("math limit: angles beyond half a turn are reached the way round that the bounds go") {
  const LimitSpace space = about(0, 0, 270);
  CHECK(near(limited({-100, 0, 0}, space), {-100, 0, 0}));  // 260
  CHECK(near(limited({-80, 0, 0}, space), {-90, 0, 0}));    // 280 stops at 270
  CHECK(near(limited({-30, 0, 0}, space), {0, 0, 0}));
}

TEST_CASE("math limit: a hinge keeps the turn about its axis and loses the others") {
  LimitSpace hinge = about(0, 0, 150);
  hinge.min.y = hinge.max.y = hinge.min.z = hinge.max.z = 0;
  CHECK(near(limited({40, 10, -20}, hinge), {40, 0, 0}));
  CHECK(near(limited({-5, 10, -20}, hinge), {0, 0, 0}));
}

TEST_CASE("math limit: the order says which axis is in the middle") {
  // 80 about z, then 80 about y: as x, y, z angles something else, as z, y, x just these.
  const Quat value = math::axis_angle({0, 1, 0}, math::radians(80)) *
                     math::axis_angle({0, 0, 1}, math::radians(80));
  LimitSpace space = about(0, 0, 0);
  CHECK(angle(math::limit_rotation(value, space), value) > 10);
  space.order[0] = 2;
  space.order[2] = 0;
  CHECK(angle(math::limit_rotation(value, space), value) < 1e-5);
}

TEST_CASE("math limit: what comes out is inside, and clamping twice is clamping once") {
  test::Random random(2);
  const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < 2000; ++i) {
    LimitSpace space;
    space.axes = random.trs().rotation;
    space.rest = random.trs().rotation;
    space.origin = random.trs().translation;
    const std::size_t order = random.below(6);
    for (std::size_t k = 0; k < 3; ++k) {
      space.order[k] = orders[order][k];
      if (random.chance(70)) space.min[k] = -random.between(0, 85);
      if (random.chance(70)) space.max[k] = random.between(0, 85);
    }
    const math::Trs value = random.trs();
    const Vec3 moved = math::limit_vector(value.translation, space);
    const Vec3 measured = math::rotate(math::conjugate(space.axes), moved - space.origin);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(measured[k] > space.min[k] - 1e-9);
      CHECK(measured[k] < space.max[k] + 1e-9);
    }
    CHECK(math::length(math::limit_vector(moved, space) - moved) < 1e-9);
    const Quat turned = math::limit_rotation(value.rotation, space);
    CHECK(std::fabs(math::dot(turned, turned) - 1) < 1e-9);
    CHECK(angle(math::limit_rotation(turned, space), turned) < 1e-4);
  }
}

TEST_CASE("math limit: hostile bounds and values leave finite numbers") {
  LimitSpace space = about(0, -1e300, 1e300);
  space.min.y = space.max.y = 1e30;
  for (const Quat& q : {Quat{0, 0, 0, 0}, Quat{1e200, 0, 0, 0}, Quat{1, 0, 0, 0}, Quat{}}) {
    const Quat got = math::limit_rotation(q, space);
    CHECK(std::isfinite(got.x + got.y + got.z + got.w));
  }
  const Vec3 got = math::limit_vector({1e308, -1e308, 0}, space);
  CHECK(std::isfinite(got.x + got.y + got.z));
}
