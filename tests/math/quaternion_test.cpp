// SPDX-License-Identifier: MIT
// Quaternions as properties over random rotations, and at their singular places.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Quat;
using math::Vec3;
using test::distance;
using test::Random;

bool finite(Quat q) {
  return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

TEST_CASE("math quaternion: rotate agrees with the matrix and with products") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Quat a = random.rotation(), b = random.rotation();
    const Vec3 v = random.vector(10);
    CHECK(distance(math::rotate(a, v), math::matrix(a) * v) < 1e-14 * 10);
    CHECK(distance(math::rotate(a * b, v), math::rotate(a, math::rotate(b, v))) < 1e-13);
    CHECK(distance(math::rotate(math::conjugate(a), math::rotate(a, v)), v) < 1e-13);
    CHECK(distance(math::quaternion(math::matrix(a)), a) < 1e-15 * 8);
    CHECK(math::quaternion(math::matrix(a)).w >= 0);
  }
}

TEST_CASE("math quaternion: matrices of half turns") {
  for (const Quat q : {Quat{1, 0, 0, 0}, Quat{0, 1, 0, 0}, Quat{0, 0, 1, 0}, Quat{0, 0, 0, 1}}) {
    CHECK(math::quaternion(math::matrix(q)) == q);
  }
}

TEST_CASE("math quaternion: Euler angles turn about X, then Y, then Z") {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 angles = random.vector(360);
    const Quat x = math::axis_angle({1, 0, 0}, math::radians(angles.x));
    const Quat y = math::axis_angle({0, 1, 0}, math::radians(angles.y));
    const Quat z = math::axis_angle({0, 0, 1}, math::radians(angles.z));
    CHECK(distance(math::from_euler_degrees(angles), z * y * x) < 1e-14);
  }
}

TEST_CASE("math quaternion: Euler angles of a rotation give it back") {
  Random random(3);
  for (int i = 0; i < 5000; ++i) {
    const Quat q = random.rotation();
    const Vec3 angles = math::to_euler_degrees(q);
    CHECK(std::fabs(angles.y) <= 90);
    CHECK(distance(math::from_euler_degrees(angles), q) < 2e-15);
  }
  for (int i = 0; i < 5000; ++i) {
    Vec3 angles = random.vector(180);
    angles.y = random.between(-89, 89);
    const Vec3 back = math::to_euler_degrees(math::from_euler_degrees(angles));
    CHECK(distance(angles, back) < 1e-11);
  }
}

TEST_CASE("math quaternion: Euler angles at and near the poles") {
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    const double off = std::ldexp(1.0, -static_cast<int>(random.below(60)));
    const double pole = random.chance(50) ? 90 : -90;
    const Quat q = math::from_euler_degrees(
        {random.between(-180, 180), pole + off, random.between(-180, 180)});
    CHECK(distance(math::from_euler_degrees(math::to_euler_degrees(q)), q) < 2e-12);
  }
  for (const double y : {90.0, -90.0}) {
    for (double x = -180; x <= 180; x += 30) {
      const Vec3 angles = math::to_euler_degrees(math::from_euler_degrees({x, y, 20}));
      CHECK(angles.z == 0);
      CHECK(angles.y == doctest::Approx(y));
    }
  }
}

TEST_CASE("math quaternion: slerp goes the shorter way at constant speed") {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Quat a = random.rotation(), b = random.rotation();
    const double t = random.between(0, 1);
    const Quat m = math::slerp(a, b, t);
    const double whole = std::acos(std::fmin(1.0, std::fabs(math::dot(a, b))));
    const double part = std::acos(std::fmin(1.0, std::fabs(math::dot(a, m))));
    CHECK(part == doctest::Approx(whole * t).epsilon(1e-7));
    CHECK(std::fabs(math::dot(m, m) - 1) < 1e-15 * 8);
    CHECK(distance(math::slerp(a, -b, t), m) < 1e-14);
    CHECK(distance(math::slerp(a, b, 0), a) < 1e-15);
    CHECK(distance(math::slerp(a, b, 1), b) < 1e-15);
  }
}

TEST_CASE("math quaternion: slerp of nearly equal rotations") {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Quat a = random.rotation();
    const double angle = std::ldexp(1.0, -static_cast<int>(random.below(70)));
    const Vec3 axis = random.direction();
    const Quat b = math::axis_angle(axis, angle) * a;
    const Quat want = math::axis_angle(axis, angle / 4) * a;
    CHECK(distance(math::slerp(a, b, 0.25), want) < 1e-15);
  }
  CHECK(finite(math::slerp({0, 0, 0, 1}, {1, 0, 0, 0}, 0.5)));
  CHECK(finite(math::slerp({0, 0, 0, 0}, {0, 0, 0, 0}, 0.5)));
}

TEST_CASE("math quaternion: between is the shortest rotation") {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random.direction(), b = random.direction();
    const Quat q = math::between(a, b);
    CHECK(distance(math::rotate(q, a), b) < 1e-15 * 4);
    CHECK(std::fabs(math::dot(Vec3{q.x, q.y, q.z}, a)) < 1e-15);
    CHECK(q.w >= 0);
  }
}

TEST_CASE("math quaternion: between nearly opposite directions") {
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random.direction();
    const double off = std::ldexp(1.0, -static_cast<int>(random.below(70)));
    const Vec3 b = math::normalised(-a + math::perpendicular(a) * off);
    CHECK(distance(math::rotate(math::between(a, b), a), b) < 1e-14);
    CHECK(distance(math::rotate(math::between(a, -a), a), -a) < 1e-15);
  }
}

TEST_CASE("math quaternion: normalised, or identity") {
  CHECK(math::normalised(Quat{0, 0, 0, 0}) == Quat{});
  CHECK(math::normalised(Quat{0, 0, 0, 1e-31}) == Quat{});
  CHECK(math::normalised(Quat{0, 3, 0, 4}) == Quat{0, 0.6, 0, 0.8});
  CHECK(distance(math::normalised(Quat{0, 1e200, 0, 1e200}),
                 Quat{0, std::sqrt(0.5), 0, std::sqrt(0.5)}) < 1e-15);
}

}  // namespace
}  // namespace rigc
