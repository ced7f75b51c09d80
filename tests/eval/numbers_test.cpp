// SPDX-License-Identifier: MIT
// Kernels of formulas against twins in long double, on random and on nasty numbers; nothing but
// finite numbers comes out.
#include <doctest/doctest.h>

#include <functional>

#include "tests/eval/kernel_runner.h"

namespace rigc {
namespace {

using eval::Op;
using test::Arguments;
using test::Random;
using Real = long double;

struct Row {
  Op op;
  std::function<Real(Real, Real, Real)> twin;
};

const Real kDegree = 3.141592653589793238462643383279502884L / 180;

Real power(Real a, Real b) {
  if (b == 0 || a == 1) return 1;
  if (a == 0) return 0;
  if (a < 0 && floorl(b) != b) return 0;
  return powl(a, b);
}

Real smooth(Real low, Real high, Real x) {
  if (low == high) return x >= low ? 1 : 0;
  const Real t = (x - low) / (high - low);
  if (t <= 0) return 0;
  if (t >= 1) return 1;
  return t * t * (3 - 2 * t);
}

const Row kRows[] = {
    {Op::negate, [](Real a, Real, Real) { return -a; }},
    {Op::logical_not, [](Real a, Real, Real) { return a == 0 ? 1.0L : 0.0L; }},
    {Op::add, [](Real a, Real b, Real) { return a + b; }},
    {Op::subtract, [](Real a, Real b, Real) { return a - b; }},
    {Op::multiply_numbers, [](Real a, Real b, Real) { return a * b; }},
    {Op::divide, [](Real a, Real b, Real) { return b == 0 ? 0 : a / b; }},
    {Op::power, [](Real a, Real b, Real) { return power(a, b); }},
    {Op::less, [](Real a, Real b, Real) { return a < b ? 1.0L : 0.0L; }},
    {Op::less_equal, [](Real a, Real b, Real) { return a <= b ? 1.0L : 0.0L; }},
    {Op::greater, [](Real a, Real b, Real) { return a > b ? 1.0L : 0.0L; }},
    {Op::greater_equal, [](Real a, Real b, Real) { return a >= b ? 1.0L : 0.0L; }},
    {Op::equal, [](Real a, Real b, Real) { return a == b ? 1.0L : 0.0L; }},
    {Op::not_equal, [](Real a, Real b, Real) { return a != b ? 1.0L : 0.0L; }},
    {Op::logical_and, [](Real a, Real b, Real) { return a != 0 && b != 0 ? 1.0L : 0.0L; }},
    {Op::logical_or, [](Real a, Real b, Real) { return a != 0 || b != 0 ? 1.0L : 0.0L; }},
    {Op::select, [](Real a, Real b, Real c) { return a != 0 ? b : c; }},
    {Op::sin, [](Real a, Real, Real) { return sinl(fmodl(a, 360) * kDegree); }},
    {Op::cos, [](Real a, Real, Real) { return cosl(fmodl(a, 360) * kDegree); }},
    {Op::asin, [](Real a, Real, Real) { return asinl(a > 1    ? 1
                                                     : a < -1 ? -1
                                                              : a) /
                                               kDegree; }},
    {Op::acos, [](Real a, Real, Real) { return acosl(a > 1    ? 1
                                                     : a < -1 ? -1
                                                              : a) /
                                               kDegree; }},
    {Op::atan, [](Real a, Real, Real) { return atanl(a) / kDegree; }},
    {Op::atan2, [](Real a, Real b, Real) { return atan2l(a, b) / kDegree; }},
    {Op::sqrt, [](Real a, Real, Real) { return a > 0 ? sqrtl(a) : 0; }},
    {Op::abs, [](Real a, Real, Real) { return fabsl(a); }},
    {Op::sign, [](Real a, Real, Real) { return a > 0   ? 1.0L
                                               : a < 0 ? -1.0L
                                                       : 0.0L; }},
    {Op::floor, [](Real a, Real, Real) { return floorl(a); }},
    {Op::ceil, [](Real a, Real, Real) { return ceill(a); }},
    {Op::round, [](Real a, Real, Real) { return roundl(a); }},
    {Op::exp, [](Real a, Real, Real) { return expl(a); }},
    {Op::log, [](Real a, Real, Real) { return a > 0 ? logl(a) : 0; }},
    {Op::min, [](Real a, Real b, Real) { return fminl(a, b); }},
    {Op::max, [](Real a, Real b, Real) { return fmaxl(a, b); }},
    {Op::clamp, [](Real a, Real b, Real c) { return fminl(fmaxl(a, b), c); }},
    {Op::lerp, [](Real a, Real b, Real c) { return a + (b - a) * c; }},
    {Op::smoothstep, [](Real a, Real b, Real c) { return smooth(a, b, c); }},
    {Op::hypot, [](Real a, Real b, Real) { return hypotl(a, b); }},
};

Arguments take(Op op, double a, double b, double c) {
  const scene::Value all[] = {a, b, c};
  return Arguments(all, all + eval::row(op).arguments);
}

TEST_CASE("eval numbers: every kernel of a formula has a twin") {
  // tan and modulo have tests of their own below.
  CHECK(std::size(kRows) + 2 ==
        static_cast<std::size_t>(Op::count) - static_cast<std::size_t>(Op::negate));
}

TEST_CASE("eval numbers: kernels equal their twins") {
  Random random(1);
  for (const Row& row : kRows) {
    CAPTURE(eval::row(row.op).name);
    for (int i = 0; i < 400; ++i) {
      std::vector<Arguments> lanes;
      std::vector<Real> want;
      for (int lane = 0; lane < eval::kLanes; ++lane) {
        const auto draw = [&] {
          return random.chance(20) ? static_cast<double>(random.below(5)) - 2
                                   : random.between(-20, 20);
        };
        const double a = draw(), b = draw(), c = draw();
        lanes.push_back(take(row.op, a, b, c));
        want.push_back(row.twin(static_cast<Real>(a), static_cast<Real>(b), static_cast<Real>(c)));
      }
      const auto got = test::run_kernel(row.op, lanes, {}, 1);
      for (std::size_t lane = 0; lane < want.size(); ++lane) {
        const double wanted = static_cast<double>(want[lane]);
        REQUIRE(std::fabs(got[lane][0] - wanted) <= 1e-14 * std::fmax(1.0, std::fabs(wanted)));
      }
    }
  }
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
