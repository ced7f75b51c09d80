// SPDX-License-Identifier: MIT
// The kernels of transforms against math, and Euler angles. Their twins are in twins_test.cpp.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"
#include "tests/eval/twins.h"

namespace rigc {
namespace {

using eval::Op;
using test::Numbers;
using test::Random;

TEST_CASE("eval transforms: compose of a lost rotation") {
  const Numbers got = test::run_kernel_once(
      Op::compose, {math::Vec3{1, 2, 3}, math::Quat{0, 0, 0, 0}, math::Vec3{2, 2, 2}}, {}, 12);
  CHECK(got == Numbers{2, 0, 0, 0, 2, 0, 0, 0, 2, 1, 2, 3});
}

TEST_CASE("eval transforms: compose agrees with math") {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const math::Trs trs = random.trs(false);
    const Numbers want = eval::numbers_of(
        math::compose({trs.translation, math::normalised(trs.rotation), trs.scale}));
    const Numbers got =
        test::run_kernel_once(Op::compose, {trs.translation, trs.rotation, trs.scale}, {}, 12);
    CHECK(test::difference(got, want) < 1e-15);
  }
}

TEST_CASE("eval transforms: multiply gives the bits of math") {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const math::Affine a = math::compose(random.trs(false)), b = math::compose(random.trs(false));
    CHECK(test::run_kernel_once(Op::multiply, {a, b}, {}, 12) == eval::numbers_of(a * b));
  }
}

TEST_CASE("eval transforms: gather") {
  const Numbers got = test::run_kernel_once(Op::gather, {1.5, math::Vec3{2, 3, 4}, -0.5}, {}, 5);
  CHECK(got == Numbers{1.5, 2, 3, 4, -0.5});
}

TEST_CASE("eval transforms: Euler angles") {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const math::Vec3 angles = random.vector(400);
    const twin::M want = twin::times(twin::turn(2, angles.z),
                                     twin::times(twin::turn(1, angles.y), twin::turn(0, angles.x)));
    const Numbers q = test::run_kernel_once(Op::from_euler, {angles}, {}, 4);
    CHECK(twin::angle_between(twin::turn(test::quat_of(q)), want) < 1e-13);
    const Numbers back = test::run_kernel_once(Op::to_euler, {test::quat_of(q)}, {}, 3);
    const twin::M again = twin::times(twin::turn(2, back[2]),
                                      twin::times(twin::turn(1, back[1]), twin::turn(0, back[0])));
    CHECK(twin::angle_between(again, want) < 1e-13);
  }
  CHECK(test::run_kernel_once(Op::to_euler, {math::Quat{0, 0, 0, 0}}, {}, 3) == Numbers{0, 0, 0});
}

}  // namespace
}  // namespace rigc
