// SPDX-License-Identifier: MIT
// math against Eigen: products, inverses, rotations and Euler angles as somebody else computes
// them.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "math/random.h"

namespace rigc {
namespace {

using math::Affine;
using math::Quat;
using math::Vec3;

Eigen::Vector3d eigen(Vec3 v) { return {v.x, v.y, v.z}; }
Eigen::Quaterniond eigen(Quat q) { return {q.w, q.x, q.y, q.z}; }

Eigen::Affine3d eigen(const Affine& a) {
  Eigen::Affine3d out;
  out.linear() << eigen(a.linear.x), eigen(a.linear.y), eigen(a.linear.z);
  out.translation() = eigen(a.origin);
  return out;
}

double difference(const Affine& a, const Eigen::Affine3d& b) {
  return (eigen(a).matrix() - b.matrix()).norm();
}

}  // namespace

TEST_CASE("math: agrees with Eigen") {
  test::Random random(20);
  for (int i = 0; i < 2000; ++i) {
    const Quat q = random.rotation();
    const Quat p = random.rotation();
    const Vec3 v = random.vector();
    const Vec3 t = random.vector();
    const Vec3 scale{random.between(0.5, 2.5), random.between(0.5, 2.5), random.between(0.5, 2.5)};
    CHECK((eigen(math::rotate(q, v)) - eigen(q) * eigen(v)).norm() < 1e-14);
    CHECK(std::abs(std::abs((eigen(q * p)).dot(eigen(q) * eigen(p))) - 1) < 1e-14);

    const Affine trs = math::compose({t, q, scale});
    const Eigen::Affine3d same =
        Eigen::Translation3d(eigen(t)) * eigen(q) * Eigen::Scaling(eigen(scale));
    CHECK(difference(trs, same) < 1e-14);
    const Affine other = math::compose({v, p, {1, 1, 1}});
    CHECK(difference(trs * other, same * eigen(other)) < 1e-14);
    CHECK(difference(math::inverse(trs), same.inverse()) < 1e-11);
    CHECK(math::determinant(trs.linear) ==
          doctest::Approx(same.linear().determinant()).epsilon(1e-12));
    CHECK((eigen(math::matrix(q) * v) - eigen(q).toRotationMatrix() * eigen(v)).norm() < 1e-14);

    const Vec3 angles = random.vector() * 180;
    const auto radians = [](double degrees) { return degrees * (math::kPi / 180); };
    const Eigen::Quaterniond euler =
        Eigen::AngleAxisd(radians(angles.z), Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(radians(angles.y), Eigen::Vector3d::UnitY()) *
        Eigen::AngleAxisd(radians(angles.x), Eigen::Vector3d::UnitX());
    CHECK(std::abs(std::abs(eigen(math::from_euler_degrees(angles)).dot(euler)) - 1) < 1e-14);
    const double share = random.between(0, 1);
    CHECK(std::abs(std::abs(eigen(math::slerp(q, p, share)).dot(eigen(q).slerp(share, eigen(p)))) -
                   1) < 1e-12);
  }
}

}  // namespace rigc
