// SPDX-License-Identifier: MIT
// Matrices and transforms as properties over random ones, and degenerate ones.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Affine;
using math::Mat3;
using math::Trs;
using math::Vec3;
using test::distance;
using test::Random;

bool finite(const Mat3& m) {
  for (const Vec3& v : {m.x, m.y, m.z}) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  }
  return true;
}

bool right_handed_frame(const Mat3& m) {
  return distance(math::transposed(m) * m, Mat3{}) < 1e-14 && math::determinant(m) > 0;
}

Mat3 random_matrix(Random& random) {
  const Vec3 x = random.vector(), y = random.vector(), z = random.vector();
  return {x, y, z};
}

TEST_CASE("math transform: inverse") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Mat3 m = random_matrix(random);
    if (std::fabs(math::determinant(m)) < 1e-3) continue;
    CHECK(distance(m * math::inverse(m), Mat3{}) < 1e-11);
    const Affine a{m, random.vector(5)};
    CHECK(distance(a * math::inverse(a), Affine{}) < 1e-10);
  }
}

TEST_CASE("math transform: inverse of extreme and of singular matrices") {
  const Mat3 small{{1e-100, 0, 0}, {0, 1e-110, 0}, {0, 0, 1e-120}};
  CHECK(math::inverse(small).x.x == doctest::Approx(1e100));
  CHECK(math::inverse(small).z.z == doctest::Approx(1e120));
  const Mat3 zero{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  CHECK(math::inverse(zero) == zero);
  CHECK(math::inverse(Mat3{{1, 2, 3}, {2, 4, 6}, {0, 0, 1}}) == zero);
  CHECK(math::inverse(Mat3{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}) == zero);
}

TEST_CASE("math transform: decompose undoes compose") {
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const Trs trs = random.trs(false);
    const Trs back = math::decompose(math::compose(trs));
    CHECK(distance(back.translation, trs.translation) == 0);
    CHECK(distance(back.rotation, trs.rotation) < 1e-14);
    CHECK(distance(back.scale, trs.scale) < 1e-14 * 10);
    CHECK(math::shear(math::compose(trs)) < 1e-14);
  }
}

TEST_CASE("math transform: compose undoes decompose where there is no shear") {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    Trs trs = random.trs(false);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (random.chance(30)) trs.scale[axis] = -trs.scale[axis];
    }
    const Affine a = math::compose(trs);
    const Trs parts = math::decompose(a);
    CHECK(distance(math::compose(parts), a) < 1e-13);
    CHECK(parts.scale.x > 0);
    CHECK(parts.scale.y > 0);
    CHECK((parts.scale.z < 0) == (math::determinant(a.linear) < 0));
  }
}

TEST_CASE("math transform: a rotation survives scales of zero") {
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Trs trs = random.trs(false);
      trs.scale[axis] = 0;
      const Trs back = math::decompose(math::compose(trs));
      CHECK(distance(back.rotation, trs.rotation) < 1e-14);
      CHECK(std::fabs(back.scale[axis]) == 0);
    }
  }
}

TEST_CASE("math transform: orthonormal of anything is a right-handed frame") {
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    Mat3 m = random_matrix(random);
    for (Vec3* column : {&m.x, &m.y, &m.z}) {
      if (random.chance(20)) *column = {};
      if (random.chance(20)) *column = m.x * random.between(-2, 2);
      if (random.chance(20)) *column = *column * 1e-20;
    }
    CHECK(right_handed_frame(math::orthonormal(m)));
  }
  CHECK(math::orthonormal({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}) == Mat3{});
  CHECK(math::orthonormal({{2, 0, 0}, {0, 0, 0}, {0, 0, 0}}) == Mat3{});
  CHECK(math::orthonormal({{0, 0, 0}, {0, 3, 0}, {0, 0, 0}}) == Mat3{});
}

TEST_CASE("math transform: frame holds its first axis and leans its second") {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 primary = random.direction();
    const Vec3 secondary = random.chance(10)   ? primary * 3.0
                           : random.chance(10) ? Vec3{}
                                               : random.vector();
    const Mat3 f = math::frame(primary, secondary);
    CHECK(right_handed_frame(f));
    CHECK(f.x == primary);
    CHECK(math::dot(f.y, secondary) >= -1e-14);
    CHECK(std::fabs(math::dot(f.z, secondary)) < 1e-14);
  }
}

TEST_CASE("math transform: shear is seen") {
  CHECK(math::shear({{{1, 0, 0}, {0.5, 1, 0}, {0, 0, 1}}, {}}) > 0.3);
  CHECK(math::shear({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}}) == 0);
  CHECK(math::shear({{{1, 0, 0}, {0, -2, 0}, {0, 0, 1}}, {}}) < 1e-15);
}

TEST_CASE("math transform: degenerate input leaves finite numbers") {
  for (const double size : {0.0, 1e-300, 1e-160, 1e150}) {
    const Mat3 m{{size, 0, 0}, {size, size, 0}, {0, 0, size}};
    CHECK(finite(math::orthonormal(m)));
    CHECK(finite(math::inverse(m)));
    CHECK(std::isfinite(math::shear({m, {}})));
  }
}

}  // namespace
}  // namespace rigc
