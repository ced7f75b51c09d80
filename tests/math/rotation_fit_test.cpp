// SPDX-License-Identifier: MIT
// Rotations found again from the points that they turned.
#include <doctest/doctest.h>

#include <vector>

#include "math/random.h"

using namespace rigc;
using namespace rigc::math;

namespace {

Mat3 correlation_of(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  Mat3 m{{}, {}, {}};
  for (std::size_t i = 0; i < from.size(); ++i)
    m = {m.x + to[i] * from[i].x, m.y + to[i] * from[i].y, m.z + to[i] * from[i].z};
  return m;
}

double squares(const std::vector<Vec3>& from, const std::vector<Vec3>& to, Quat turn) {
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3 off = to[i] - rotate(turn, from[i]);
    sum += dot(off, off);
  }
  return sum;
}

}  // namespace

TEST_CASE("math rotation fit: finds the rotation that turned the points, also flat ones") {
  test::Random random(11);
  for (int round = 0; round < 200; ++round) {
    const Quat turn = random.rotation();
    const bool flat = random.chance(50);
    const double size = random.any_size(20, 1);
    std::vector<Vec3> from, to;
    for (int i = 0; i < 6; ++i) {
      Vec3 point = random.vector(size);
      if (flat) point.z = 0;
      from.push_back(point);
      to.push_back(rotate(turn, point) * 3.0);
    }
    const auto found = fit_rotation(correlation_of(from, to));
    REQUIRE(found);
    CHECK(std::abs(dot(*found, turn)) > 1 - 1e-12);
  }
}

TEST_CASE("math rotation fit: no other rotation is better where points are off") {
  test::Random random(12);
  for (int round = 0; round < 100; ++round) {
    std::vector<Vec3> from, to;
    for (int i = 0; i < 5; ++i) {
      from.push_back(random.vector());
      to.push_back(random.vector());
    }
    const auto found = fit_rotation(correlation_of(from, to));
    REQUIRE(found);
    const double best = squares(from, to, *found);
    for (int i = 0; i < 50; ++i) {
      const Vec3 axis = random.direction();
      CHECK(squares(from, to, axis_angle(axis, random.between(1e-3, 3)) * *found) >= best - 1e-9);
    }
  }
}

TEST_CASE("math rotation fit: points on a line, one point and none have no single rotation") {
  const std::vector<Vec3> line = {{1, 2, 3}, {-2, -4, -6}, {0.5, 1, 1.5}};
  CHECK_FALSE(fit_rotation(correlation_of(line, line)));
  CHECK_FALSE(fit_rotation(correlation_of({{1, 0, 0}}, {{0, 1, 0}})));
  CHECK_FALSE(fit_rotation(correlation_of({}, {})));
}
