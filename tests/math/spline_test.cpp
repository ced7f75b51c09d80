// SPDX-License-Identifier: MIT
// The curve through points: passes through them, has no corners, makes no loops; lengths along it,
// the nearest place.
#include "math/spline.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/generic/spline.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Spline;
using math::Vec3;
using test::Random;

std::vector<Vec3> random_points(Random& random, std::size_t count) {
  std::vector<Vec3> points;
  Vec3 at;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(at);
    at = at + random.arrow(0.2, 1);
  }
  return points;
}

TEST_CASE("math spline: passes through its points, in one direction from both sides") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Vec3> points = random_points(random, 2 + random.below(7));
    const Spline spline(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double x = static_cast<double>(k);
      CHECK(test::distance(spline.at(x), points[k]) < 1e-14);
      if (k == 0 || k + 1 == points.size()) continue;
      // Straight on, unless the way turns back on itself.
      const Vec3 before = spline.slope(x - 1e-9), after = spline.slope(x);
      if (math::length(spline.directions()[k]) < 0.01) continue;
      CHECK(test::distance(math::normalised(before), math::normalised(after)) < 1e-5);
    }
  }
}

TEST_CASE("math spline: the slope is the derivative") {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Spline spline(random_points(random, 4));
    const double x = random.between(0.01, 2.9);
    if (std::fabs(x - std::round(x)) < 1e-3) continue;
    const Vec3 slope = (spline.at(x + 1e-6) - spline.at(x - 1e-6)) * 5e5;
    CHECK(test::distance(slope, spline.slope(x)) < 1e-7);
  }
}

TEST_CASE("math spline: points in a row give an even line, points on a circle nearly the circle") {
  const Spline line({{0, 0, 0}, {1, 0, 0}, {1.5, 0, 0}, {4, 0, 0}});
  for (int i = 0; i <= 30; ++i) {
    const double x = i / 10.0;
    const double whole = std::fmin(std::floor(x), 2), t = x - whole;
    const double ends[] = {0, 1, 1.5, 4};
    const auto k = static_cast<std::size_t>(whole);
    CHECK(test::distance(line.at(x), {ends[k] + (ends[k + 1] - ends[k]) * t, 0, 0}) < 1e-14);
  }
  std::vector<Vec3> points;
  for (int i = 0; i <= 4; ++i) {
    const double angle = math::kPi * i / 8;
    points.push_back({std::cos(angle), std::sin(angle), 0});
  }
  const Spline circle(points);
  for (int i = 0; i <= 40; ++i) {
    const double radius = math::length(circle.at(i / 10.0));
    CHECK(radius == doctest::Approx(1).epsilon(2e-3));
  }
  CHECK(circle.length() == doctest::Approx(math::kPi / 2).epsilon(2e-3));
}

TEST_CASE("math spline: it keeps near its points, however unevenly they lie") {
  // A point that comes close to its neighbour makes no loop, and no swing beyond a quarter of the
  // way to the next.
  for (const double near : {0.5, 0.1, 1e-3, 1e-9}) {
    const Spline spline({{0, 0, 0}, {1, 0, 0}, {1 + near, 0.0, 0}, {1 + near, 1, 0}});
    for (int i = 0; i <= 300; ++i) {
      const Vec3 p = spline.at(i / 100.0);
      CHECK(p.x > -0.01);
      CHECK(p.x < 1 + near + 0.25);
      CHECK(p.y > -0.25);
      CHECK(p.y < 1.01);
    }
  }
}

TEST_CASE("math spline: points in one place") {
  const Spline spline({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  CHECK(spline.at(0.7) == Vec3{1, 2, 3});
  CHECK(spline.slope(1.2) == Vec3{});
  CHECK(spline.length() == 0);
  CHECK(spline.nearest({5, 5, 5}) == 0);
}

TEST_CASE("math spline: the nearest place, and the way to it") {
  Random random(3);
  const Spline line({{0, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  CHECK(line.nearest({0.5, 1, 0}) == doctest::Approx(0.25).epsilon(1e-9));
  CHECK(line.nearest({2.5, 0, -3}) == doctest::Approx(1.5).epsilon(1e-9));
  CHECK(line.nearest({-4, 1, 0}) == 0);
  CHECK(line.nearest({9, 1, 0}) == 2);
  CHECK(line.passed(1.5) == doctest::Approx(2.5));
  CHECK(line.passed(-1) == 0);
  for (int i = 0; i < 50; ++i) {
    const Spline spline(random_points(random, 5));
    const double x = random.between(0, 4);
    CHECK(test::distance(spline.at(spline.nearest(spline.at(x))), spline.at(x)) < 1e-6);
  }
}

TEST_CASE("math spline: the shortest swing of an axis") {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = random.direction(), to = random.direction();
    const Vec3 y = math::normalised(math::cross(x, random.direction()));
    const Vec3 got = math::generic::swung(y, x, to);
    CHECK(test::distance(got, math::rotate(math::between(x, to), y)) < 1e-12);
  }
  CHECK(math::generic::swung(Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}) == Vec3{0, 1, 0});
}

}  // namespace
}  // namespace rigc
