// SPDX-License-Identifier: MIT
// Tests of src/catalog/polyline.cpp.
#include "catalog/polyline.h"

#include <doctest/doctest.h>

#include "math/math.h"

using namespace rigc::catalog;

namespace {

double distance(const Point& a, const Point& b) {
  return rigc::math::length({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

void check_near(const Point& a, const Point& b) { CHECK(distance(a, b) < 1e-12); }

}  // namespace

TEST_CASE("catalog polyline: a circle is closed, round and exact at quarter turns") {
  Arc arc;
  arc.segments = 8;
  const Polyline points = polyline(arc);
  REQUIRE(points.size() == 9);
  CHECK(points.front() == points.back());
  CHECK(points[0] == Point{0, 0, 0.5});
  CHECK(points[2] == Point{0.5, 0, 0});
  for (const Point& point : points) CHECK(distance(point, {0, 0, 0}) == doctest::Approx(0.5));
}

TEST_CASE("catalog polyline: arcs begin and end where they should") {
  Arc arc;
  arc.axis = 'x';
  arc.centre = {1, 2, 3};
  arc.radius = 2;
  arc.from = 0;
  arc.to = 90;
  check_near(polyline(arc).front(), {1, 4, 3});
  check_near(polyline(arc).back(), {1, 2, 5});
  arc.axis = 'z';
  check_near(polyline(arc).back(), {3, 2, 3});
  arc.axis = 'y';
  arc.to = -90;
  check_near(polyline(arc).back(), {-1, 2, 3});
}

TEST_CASE("catalog polyline: a smooth curve passes its points") {
  const Polyline given = {{0, 0, 0}, {1, 0, 1}, {2, 0, -1}, {3, 0, 0}};
  const Polyline curve = smooth(given);
  REQUIRE(curve.size() == 19);
  for (std::size_t i = 0; i < given.size(); ++i) check_near(curve[6 * i], given[i]);
}

TEST_CASE("catalog polyline: a smooth curve through a straight line stays on it") {
  for (const Point& point : smooth({{0, 0, 0}, {1, 0, 1}, {2, 0, 2}})) {
    CHECK(point[0] == doctest::Approx(point[2]));
  }
}

TEST_CASE("catalog polyline: a closed smooth curve has no corner at its seam") {
  const Polyline curve = smooth({{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}});
  CHECK(curve.front() == curve.back());
  const Point& after = curve[1];
  const Point& before = curve[curve.size() - 2];
  CHECK(after[0] == doctest::Approx(-before[0]));
  CHECK(after[2] == doctest::Approx(before[2]));
}

TEST_CASE("catalog polyline: turns and mirrors") {
  const Polyline line = {{1, 2, 3}, {0, 0, 1}};
  CHECK(turned(line, 0, 4) == line);
  check_near(turned(line, 1, 4)[1], {1, 0, 0});
  check_near(turned(line, 2, 4)[0], {-1, 2, -3});
  CHECK(mirrored(line, 0) == Polyline{{-1, 2, 3}, {0, 0, 1}});
  CHECK(mirrored(line, 1) == Polyline{{1, -2, 3}, {0, 0, 1}});
}
