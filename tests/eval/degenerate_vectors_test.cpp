// SPDX-License-Identifier: MIT
// The degenerate cases of formulas over vectors, rotations and matrices by name, each with its
// answer written out: directions of nothing, opposite ones, half turns, flat and mirrored matrices.
#include <doctest/doctest.h>

#include "tests/eval/answers.h"

namespace rigc {
namespace {

using eval::Op;
using exact::A;
using exact::M;
using exact::V;
using math::Affine;
using math::Quat;
using math::Vec3;
using test::Arguments;
using test::kTight;
using test::Numbers;
using test::off;
using test::run_kernel_once;
using test::turn_z;

const Quat kHalfX{1, 0, 0, 0}, kHalfY{0, 1, 0, 0}, kHalfZ{0, 0, 1, 0};

Quat about_z(double degrees) { return math::from_euler_degrees({0, 0, degrees}); }
Numbers vector_of(Op op, const Arguments& a) { return run_kernel_once(op, a, {}, 3); }
Numbers rotation_of(Op op, const Arguments& a) { return run_kernel_once(op, a, {}, 4); }
double number_of(Op op, const Arguments& a) { return run_kernel_once(op, a, {}, 1)[0]; }
Numbers inverse_of(const Affine& a) { return run_kernel_once(Op::matrix_inverse, {a}, {}, 12); }
Affine flat(Vec3 scale) { return math::compose({{1, 2, 3}, about_z(90), scale}); }

TEST_CASE("eval degenerate: normalise and length, vectors of nearly nothing and of enormous size") {
  CHECK(vector_of(Op::normalise, {Vec3{}}) == Numbers{0, 0, 0});
  CHECK(vector_of(Op::normalise, {Vec3{1e-31, 0, 0}}) == Numbers{0, 0, 0});
  CHECK(vector_of(Op::normalise, {Vec3{0, 1e-29, 0}}) == Numbers{0, 1, 0});
  CHECK(vector_of(Op::normalise, {Vec3{0, 0, -1e300}}) == Numbers{0, 0, -1});
  CHECK(number_of(Op::length, {Vec3{}}) == 0);
  CHECK(number_of(Op::length, {Vec3{3e-200, 0, 4e-200}}) == doctest::Approx(5e-200).epsilon(1e-15));
  CHECK(number_of(Op::length, {Vec3{3e200, 4e200, 0}}) == doctest::Approx(5e200).epsilon(1e-15));
}

TEST_CASE("eval degenerate: vectors that are the same or parallel") {
  const Vec3 a{1, -2, 3};
  CHECK(vector_of(Op::cross, {a, a * -2.0}) == Numbers{0, 0, 0});
  CHECK(number_of(Op::dot, {a, Vec3{2, 1, 0}}) == 0);
  CHECK(vector_of(Op::vector_lerp, {a, a, 7.0}) == Numbers{1, -2, 3});
  CHECK(vector_of(Op::vector_lerp, {a, Vec3{2, 0, 0}, -1.0}) == Numbers{0, -4, 6});  // beyond 0..1
}

TEST_CASE("eval degenerate: rotations of no length are none, of any length the same") {
  const Quat none{0, 0, 0, 0}, tiny{1e-31, 0, 0, 0}, small{0, 0, 1e-29, 0}, huge{0, 0, 1e160, 0};
  for (const Quat& q : {none, tiny}) {
    CHECK(rotation_of(Op::rotation_multiply, {q, kHalfZ}) == Numbers{0, 0, 1, 0});
    CHECK(rotation_of(Op::rotation_multiply, {kHalfZ, q}) == Numbers{0, 0, 1, 0});
    CHECK(off({M{}}, rotation_of(Op::rotation_inverse, {q})) == 0);
    CHECK(vector_of(Op::rotation_apply, {q, Vec3{1, 2, 3}}) == Numbers{1, 2, 3});
    CHECK(rotation_of(Op::rotation_slerp, {q, Quat{}, 0.5}) == Numbers{0, 0, 0, 1});
    CHECK(number_of(Op::twist_angle, {q, Vec3{0, 0, 1}}) == 0);
  }
  for (const Quat& q : {small, huge}) {
    CHECK(vector_of(Op::rotation_apply, {q, Vec3{1, 2, 3}}) == Numbers{-1, -2, 3});
    CHECK(off({turn_z(180)}, rotation_of(Op::rotation_inverse, {q})) < kTight);
    CHECK(std::fabs(number_of(Op::twist_angle, {q, Vec3{0, 0, 1}})) == 180);
  }
}

// Each of length 1e-20: together they would count as none.
TEST_CASE("eval degenerate: the product of short rotations is at unit length") {
  const Quat third = about_z(60), half = about_z(20);
  const auto shorter = [](const Quat& q) {
    return Quat{q.x * 1e-20, q.y * 1e-20, q.z * 1e-20, q.w * 1e-20};
  };
  const Numbers got = rotation_of(Op::rotation_multiply, {shorter(third), shorter(half)});
  CHECK(off({turn_z(80)}, got) < kTight);
  const Quat q = test::quat_of(got);
  CHECK(math::dot(q, q) == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("eval degenerate: slerp, parts outside 0..1, signs, half a turn apart") {
  const auto at = [](const Quat& a, const Quat& b, double t) {
    return rotation_of(Op::rotation_slerp, {a, b, t});
  };
  CHECK(off({turn_z(10)}, at(about_z(10), about_z(90), -3)) < kTight);
  CHECK(off({turn_z(90)}, at(about_z(10), about_z(90), 3)) < kTight);
  // Opposite quaternions are one rotation: the nearer way.
  for (const Quat& b : {about_z(90), -about_z(90)})
    CHECK(off({turn_z(30)}, at(about_z(10), b, 0.25)) < kTight);
  CHECK(off({turn_z(-10)}, at(about_z(10), about_z(-170), 1.0 / 9)) < kTight);
  // Half a turn apart: part of a half turn, whichever way.
  const exact::Turn way = exact::axis_angle(exact::turn(test::quat_of(at({}, kHalfX, 0.25))));
  CHECK(static_cast<double>(way.angle) == doctest::Approx(math::kPi / 4).epsilon(1e-14));
  CHECK(std::fabs(static_cast<double>(way.axis.x)) == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("eval degenerate: a rotation about an axis of no length is none") {
  CHECK(rotation_of(Op::axis_angle, {Vec3{}, 77.0}) == Numbers{0, 0, 0, 1});
  CHECK(rotation_of(Op::axis_angle, {Vec3{1e-31, 0, 0}, 77.0}) == Numbers{0, 0, 0, 1});
  CHECK(rotation_of(Op::axis_angle, {Vec3{0, 0, 5}, 180.0}) == Numbers{0, 0, 1, 0});
  // Whole turns are exact: no rotation is left of a hundred.
  CHECK(off({M{}}, rotation_of(Op::axis_angle, {Vec3{0, 2, 0}, 36000.0})) == 0);
}

TEST_CASE("eval degenerate: the twist of a half turn across the axis is 0, about it 180") {
  const Vec3 x{1, 0, 0};
  CHECK(number_of(Op::twist_angle, {kHalfY, x}) == 0);
  CHECK(number_of(Op::twist_angle, {kHalfZ, x}) == 0);
  CHECK(number_of(Op::twist_angle, {kHalfX, x}) == 180);
  CHECK(number_of(Op::twist_angle, {-kHalfX, x}) == -180);
  CHECK(number_of(Op::twist_angle, {kHalfX, Vec3{}}) == 0);
  // A swing past half a turn is the shorter one the other way; the twist does not notice.
  for (const double swing : {0.0, 90.0, 179.0, 181.0, 350.0}) {
    const Quat turned = about_z(swing) * math::axis_angle({1, 0, 0}, math::radians(40));
    const double twist = number_of(Op::twist_angle, {turned, Vec3{-3, 0, 0}});
    CHECK(twist == doctest::Approx(-40).epsilon(1e-12));
  }
}

TEST_CASE("eval degenerate: between directions: the same, opposite, nowhere") {
  const auto turn = [](Vec3 a, Vec3 b) { return rotation_of(Op::between, {a, b}); };
  CHECK(turn({2, 0, 0}, {5, 0, 0}) == Numbers{0, 0, 0, 1});
  for (const Vec3 nothing : {Vec3{}, {0, 1e-31, 0}}) {
    CHECK(turn(nothing, {0, 0, 1}) == Numbers{0, 0, 0, 1});
    CHECK(turn({0, 0, 1}, nothing) == Numbers{0, 0, 0, 1});
  }
  // Opposite: a half turn about an axis that is the same for the same directions.
  for (const Vec3 v : {Vec3{1, 0, 0}, {0, -2, 0}, {0, 0, 3}, {1, 2, 3}, {-1, 1e-9, 1}}) {
    const Quat q = test::quat_of(turn(v, -v));
    CHECK(test::distance(math::rotate(q, v), -v) < 1e-14 * math::length(v));
    CHECK(std::fabs(q.w) < 1e-15);
  }
}

TEST_CASE("eval degenerate: aim, secondary along the primary or nowhere: x is kept") {
  for (const Vec3 primary : {Vec3{2, 0, 0}, {0, -1, 0}, {1, 2, 3}}) {
    for (const Vec3 secondary : {primary, -primary, Vec3{}, Vec3{1e-40, 0, 0}}) {
      const Quat q = test::quat_of(rotation_of(Op::aim_rotation, {primary, secondary}));
      const Vec3 x = primary * (1 / math::length(primary));
      CHECK(test::distance(math::rotate(q, Vec3{1, 0, 0}), x) < kTight);
      CHECK(math::dot(q, q) == doctest::Approx(1).epsilon(1e-14));
    }
  }
  // No direction at all is x, and y leans to the secondary still.
  CHECK(off({exact::frame({1, 0, 0}, {0, 0, 1})},
            rotation_of(Op::aim_rotation, {Vec3{}, Vec3{1, 0, 1}})) < kTight);
  CHECK(rotation_of(Op::aim_rotation, {Vec3{}, Vec3{}}) ==
        rotation_of(Op::aim_rotation, {Vec3{1, 0, 0}, Vec3{}}));
}

TEST_CASE("eval degenerate: the rotation and scale of flat, mirrored and sheared matrices") {
  // A lost column follows from the other two.
  for (const Vec3 scale : {Vec3{0, 2, 3}, {2, 0, 3}, {2, 3, 0}, {2, 3, 1e-40}}) {
    CHECK(off({turn_z(90)}, rotation_of(Op::matrix_rotation, {flat(scale)})) < kTight);
    CHECK(off({V(scale)}, vector_of(Op::matrix_scale, {flat(scale)})) < kTight);
  }
  CHECK(rotation_of(Op::matrix_rotation, {flat({0, 0, 0})}) == Numbers{0, 0, 0, 1});
  CHECK(vector_of(Op::matrix_scale, {flat({0, 0, 0})}) == Numbers{0, 0, 0});
  // Mirrored along any axis: z is what is turned round.
  CHECK(off({V{2, 3, -4}}, vector_of(Op::matrix_scale, {flat({2, 3, -4})})) < kTight);
  CHECK(off({turn_z(-90)}, rotation_of(Op::matrix_rotation, {flat({-2, -3, 4})})) < kTight);
  CHECK(off({V{2, 3, -4}}, vector_of(Op::matrix_scale, {flat({-2, 3, 4})})) < kTight);
  // Sheared: x keeps its direction, y the plane of both.
  const Affine sheared{{{2, 0, 0}, {5, 3, 0}, {7, 7, 4}}, {}};
  CHECK(rotation_of(Op::matrix_rotation, {sheared}) == Numbers{0, 0, 0, 1});
  CHECK(vector_of(Op::matrix_scale, {sheared}) == Numbers{2, 3, 4});
}

TEST_CASE("eval degenerate: the inverse of a flat matrix is that of its rotation") {
  const A back(turn_z(-90), V{-2, 1, -3});
  for (const Vec3 scale : {Vec3{0, 2, 3}, {2, 3, 0}, {2, 3, 1e-31}})
    CHECK(off({back}, inverse_of(flat(scale)), 4) < kTight);
  CHECK(off({A(M{}, V{-1, -2, -3})}, inverse_of(flat({0, 0, 0}))) < kTight);
  const Affine spread{{{1, 0, 0}, {1, 1e-15, 0}, {0, 0, 1}}, {}};
  CHECK(off({A{}}, inverse_of(spread)) < kTight);
  // Small and mirrored ones are not flat.
  CHECK(off({A(exact::scaled(M{}, {1e20L, 1e20L, -1e20L}), {})},
            inverse_of(math::compose({{}, {}, {1e-20, 1e-20, -1e-20}}))) < kTight);
}

TEST_CASE("eval degenerate: choose takes 0 of either sign for no and everything else for yes") {
  const Vec3 yes{1, 2, 3}, no{4, 5, 6};
  for (const double condition : {0.0, -0.0})
    CHECK(vector_of(Op::choose, {condition, yes, no}) == Numbers{4, 5, 6});
  for (const double condition : {1.0, -1.0, 5e-324, 1e308})
    CHECK(vector_of(Op::choose, {condition, yes, no}) == Numbers{1, 2, 3});
}

}  // namespace
}  // namespace rigc
