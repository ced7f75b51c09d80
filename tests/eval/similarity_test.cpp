// SPDX-License-Identifier: MIT
// What counts as a rotation times a factor.
#include "eval/similarity.h"

#include <doctest/doctest.h>

#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Mat3;
using math::Vec3;

TEST_CASE("eval similarity: rotations times a positive factor, and nothing else") {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Mat3 r = math::matrix(random.rotation());
    CHECK(eval::uniform_scale(r) == 1);
    const double s = random.between(0.1, 5);
    CHECK(eval::uniform_scale({r.x * s, r.y * s, r.z * s}) == doctest::Approx(s).epsilon(1e-14));
    CHECK(eval::uniform_scale({r.x * s, r.y * s, r.z * -s}) == 0);
    CHECK(eval::uniform_scale({r.x * -s, r.y * -s, r.z * -s}) == 0);
    CHECK(eval::uniform_scale({r.x * s, r.y * s, r.z * (s * (1 + 1e-10))}) == 0);
    CHECK(eval::uniform_scale({r.x, r.y + r.x * 1e-10, r.z}) == 0);
    CHECK(eval::uniform_scale({r.x * 1e-40, r.y * 1e-40, r.z * 1e-40}) == 0);
    CHECK(eval::uniform_scale({r.x * 1e40, r.y * 1e40, r.z * 1e40}) == 0);
    CHECK(eval::uniform_scale({r.x, r.x, r.x}) == 0);
  }
  CHECK(eval::uniform_scale({{}, {}, {}}) == 0);
}

TEST_CASE("eval similarity: flat matrices span no space") {
  CHECK(eval::spans_space({}));
  CHECK(eval::spans_space({{1e-9, 0, 0}, {0, 1e9, 0}, {0, 0, -1}}));
  CHECK(!eval::spans_space({{1, 0, 0}, {0, 1, 0}, {1, 1, 1e-7}}));
  CHECK(!eval::spans_space({{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}));
}

}  // namespace
}  // namespace rigc
