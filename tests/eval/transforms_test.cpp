// SPDX-License-Identifier: MIT
// The kernels of transforms against their twins.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"
#include "tests/eval/twins.h"

namespace rigc {
namespace {

using eval::Op;
using test::Arguments;
using test::Numbers;
using test::Random;

TEST_CASE("eval transforms: compose") {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    std::vector<Arguments> lanes;
    std::vector<Numbers> want;
    for (int lane = 0; lane < eval::kLanes; ++lane) {
      math::Trs trs = random.trs(false);
      if (random.chance(20)) trs.scale.y = 0;
      if (random.chance(20)) trs.scale.x = -trs.scale.x;
      const math::Quat long_way{trs.rotation.x * 3, trs.rotation.y * 3, trs.rotation.z * 3,
                                trs.rotation.w * 3};
      lanes.push_back({trs.translation, long_way, trs.scale});
      want.push_back(eval::numbers_of(
          twin::to_affine(twin::place(trs.translation, twin::turn(trs.rotation), trs.scale))));
    }
    const auto got = test::run_kernel(Op::compose, lanes, {}, 12);
    for (std::size_t lane = 0; lane < got.size(); ++lane)
      CHECK(test::difference(got[lane], want[lane]) < 1e-14 * 4);
  }
}

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

TEST_CASE("eval transforms: multiply") {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    std::vector<Arguments> lanes;
    std::vector<Numbers> want, exact;
    for (int lane = 0; lane < eval::kLanes; ++lane) {
      const math::Affine a = math::compose(random.trs(false)), b = math::compose(random.trs(false));
      lanes.push_back({a, b});
      want.push_back(eval::numbers_of(twin::to_affine(twin::times(twin::from(a), twin::from(b)))));
      exact.push_back(eval::numbers_of(a * b));
    }
    const auto got = test::run_kernel(Op::multiply, lanes, {}, 12);
    for (std::size_t lane = 0; lane < got.size(); ++lane) {
      CHECK(test::difference(got[lane], want[lane]) < 1e-14);
      CHECK(got[lane] == exact[lane]);
    }
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
