// SPDX-License-Identifier: MIT
// Lengths and directions of ordinary, huge, tiny and zero vectors.
#include <doctest/doctest.h>

#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Vec3;
using test::Random;

TEST_CASE("math vector: length of any size") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v = random.direction();
    for (const double size : {1.0, 1e-3, 1e100, 1e-200, 1e307}) {
      CHECK(math::length(v * size) == doctest::Approx(size).epsilon(1e-14));
    }
  }
  CHECK(math::length({}) == 0);
  CHECK(math::length({3, 4, 0}) == 5);
}

TEST_CASE("math vector: normalised, or the fallback") {
  CHECK(math::normalised(Vec3{0, 0, 5}) == Vec3{0, 0, 1});
  CHECK(math::normalised({}, {0, 1, 0}) == Vec3{0, 1, 0});
  CHECK(math::normalised({1e-31, 0, 0}, {0, 1, 0}) == Vec3{0, 1, 0});
  CHECK(math::normalised(Vec3{0, 1e-29, 0}) == Vec3{0, 1, 0});
  CHECK(math::normalised(Vec3{0, -1e300, 0}) == Vec3{0, -1, 0});
}

TEST_CASE("math vector: perpendicular") {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 v = random.direction();
    const Vec3 p = math::perpendicular(v);
    CHECK(math::dot(v, p) == doctest::Approx(0).epsilon(1e-15));
    CHECK(math::length(p) == doctest::Approx(1).epsilon(1e-15));
  }
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}) {
    CHECK(math::dot(math::perpendicular(axis), axis) == 0);
  }
}

}  // namespace
}  // namespace rigc
