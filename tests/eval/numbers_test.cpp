// SPDX-License-Identifier: MIT
// Kernels of formulas: poles, remainders, nasty numbers. Their twins are in twins_test.cpp.
#include <doctest/doctest.h>

#include "tests/eval/kernel_runner.h"

namespace rigc {
namespace {

using eval::Op;
using test::Arguments;
using test::Random;
using Real = long double;

const Real kDegree = 3.141592653589793238462643383279502884L / 180;

Arguments take(Op op, double a, double b, double c) {
  const scene::Value all[] = {a, b, c};
  return Arguments(all, all + eval::row(op).arguments);
}

TEST_CASE("eval numbers: tangent, and its poles") {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double x = random.between(-89, 89);
    const double want = static_cast<double>(tanl(static_cast<Real>(x) * kDegree));
    CHECK(test::run_kernel_once(Op::tan, {x}, {}, 1)[0] == doctest::Approx(want).epsilon(1e-13));
  }
  CHECK(test::run_kernel_once(Op::tan, {90.0}, {}, 1)[0] == 0);
  CHECK(test::run_kernel_once(Op::tan, {45.0}, {}, 1)[0] == doctest::Approx(1));
}

TEST_CASE("eval numbers: the remainder has the divisor's sign and is smaller") {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const double a = random.between(-50, 50), b = random.between(-7, 7);
    const double r = test::run_kernel_once(Op::modulo, {a, b}, {}, 1)[0];
    CHECK(std::fabs(r) <= std::fabs(b));
    CHECK(r * b >= 0);
    const double turns = (a - r) / b;
    CHECK(std::fabs(turns - std::round(turns)) < 1e-9 * std::fmax(1.0, std::fabs(turns)));
  }
  CHECK(test::run_kernel_once(Op::modulo, {-1.0, 3.0}, {}, 1)[0] == 2);
  CHECK(test::run_kernel_once(Op::modulo, {5.0, 0.0}, {}, 1)[0] == 0);
}

TEST_CASE("eval numbers: finite for nasty numbers") {
  const double nasty[] = {
      0.0,  -0.0, 1.0, -1.0, 1e308, -1e308, 1e-320, -1e-320, 0x1.fffffffffffffp+1023,
      90.0, 0.5,  -7.0};
  for (auto op = static_cast<int>(Op::negate); op < static_cast<int>(Op::count); ++op) {
    CAPTURE(eval::row(static_cast<Op>(op)).name);
    for (const double a : nasty) {
      for (const double b : nasty) {
        for (const double c : nasty) {
          REQUIRE(test::all_finite(test::run_kernel_once(
              static_cast<Op>(op), take(static_cast<Op>(op), a, b, c), {}, 1)));
        }
      }
    }
  }
}

}  // namespace
}  // namespace rigc
