// SPDX-License-Identifier: MIT
// Each number of a pack gets the bits that a double alone gets, whatever stands beside it. Wider
// packs are compared as kernels, which are compiled for them: tests/eval/isa_test.cpp.
#include "math/pack.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "math/generic/exponential.h"
#include "math/generic/transforms.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Pack;
using math::root;
using math::select;

double any_number(test::Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kOdd[] = {0,      -0.0,       1,
                             -1,     0.5,        1e300,
                             -1e300, 0x1p-1022,  5e-324,
                             90,     -180,       360,
                             1e16,   0x1.8p52,   -0x1p53,
                             1e-40,  kInfinity,  -kInfinity,
                             1e308,  -0x1p-1060, std::numeric_limits<double>::quiet_NaN()};
  if (random.chance(40)) return kOdd[random.below(std::size(kOdd))];
  return random.chance(50) ? random.between(-4, 4) : random.any_size(300, 0);
}

bool same(double a, double b) {
  return (a != a && b != b) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// `f` of packs against `f` of each number.
template <int W, class F>
void compare(const char* name, F f) {
  CAPTURE(name);
  test::Random random(static_cast<std::uint64_t>(W));
  for (int i = 0; i < 3000; ++i) {
    double a[W], b[W], c[W], got[W];
    for (int lane = 0; lane < W; ++lane) {
      a[lane] = any_number(random);
      b[lane] = any_number(random);
      c[lane] = any_number(random);
    }
    const Pack<W> x = Pack<W>::load(a), y = Pack<W>::load(b), z = Pack<W>::load(c);
    f(x, y, z).store(got);
    for (int lane = 0; lane < W; ++lane) {
      const double alone = f(a[lane], b[lane], c[lane]);
      CHECK_MESSAGE(same(got[lane], alone), a[lane], " ", b[lane], " ", c[lane], ": ", got[lane],
                    " and ", alone);
    }
  }
}

template <int W>
void compare_primitives() {
  compare<W>("arithmetic", [](auto a, auto b, auto c) { return (a + b) * c - a / b; });
  compare<W>("negated", [](auto a, auto, auto) { return -a; });
  compare<W>("less", [](auto a, auto b, auto c) { return select(a < b, a, c); });
  compare<W>("less or equal", [](auto a, auto b, auto c) { return select(a <= b, a, c); });
  compare<W>("equal", [](auto a, auto b, auto c) { return select((a == b) | (b > c), a, c); });
  compare<W>("not equal",
             [](auto a, auto b, auto c) { return select((a != b) & !(b >= c), a, c); });
  compare<W>("root", [](auto a, auto, auto) { return root(math::magnitude(a)); });
  compare<W>("magnitude", [](auto a, auto, auto) { return math::magnitude(a); });
  compare<W>("with sign",
             [](auto a, auto b, auto) { return math::with_sign(math::magnitude(a), b); });
  compare<W>("remainder", [](auto a, auto b, auto) { return math::remainder(a, b); });
  compare<W>("floored", [](auto a, auto, auto) { return math::floored(a); });
}

template <int W>
void compare_formulas() {
  namespace generic = math::generic;
  compare<W>("sine", [](auto a, auto, auto) { return generic::sine_cosine(a).sine; });
  compare<W>("cosine of degrees",
             [](auto a, auto, auto) { return generic::sine_cosine_degrees(a).cosine; });
  compare<W>("tangent", [](auto a, auto, auto) { return generic::tan_degrees(a); });
  compare<W>("atan2", [](auto a, auto b, auto) { return generic::atan2(a, b); });
  compare<W>("acos", [](auto a, auto, auto) { return generic::acos(a); });
  compare<W>("exp", [](auto a, auto, auto) { return generic::exp(a); });
  compare<W>("log", [](auto a, auto, auto) { return generic::log(a); });
  compare<W>("pow", [](auto a, auto b, auto) { return generic::pow(a, b); });
  compare<W>("cbrt", [](auto a, auto, auto) { return generic::cbrt(a); });
  compare<W>("length", [](auto a, auto b, auto c) {
    return generic::length(math::Vec3Of<decltype(a)>{a, b, c});
  });
  compare<W>("slerp", [](auto a, auto b, auto c) {
    using Quat = math::QuatOf<decltype(a)>;
    const Quat from = generic::normalised(Quat{a, b, c, decltype(a)(1.0)});
    return generic::slerp(from, generic::normalised(Quat{b, c, a, c}), decltype(a)(0.25)).w;
  });
  compare<W>("inverse", [](auto a, auto b, auto c) {
    using R = decltype(a);
    const math::Mat3Of<R> m{{a, b, R(1.0)}, {R(0.5), c, b}, {c, R(2.0), a}};
    return generic::inverse(m).y.z;
  });
}

TEST_CASE("math pack: two numbers at once give the bits of one") { compare_primitives<2>(); }

TEST_CASE("math pack: formulas of two numbers give the bits of one") { compare_formulas<2>(); }

TEST_CASE("math pack: powers of two and parts of numbers") {
  for (double k = -1022; k <= 1023; ++k) CHECK(math::power_of_two(k) == std::ldexp(1.0, int(k)));
  test::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double x = std::abs(random.any_size(1000, 0));
    if (x == 0) continue;
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent);
    CHECK(math::parts_of(x).mantissa == mantissa);
    CHECK(math::parts_of(x).exponent == exponent);
    const double k = std::floor(random.between(-900, 900));
    CHECK(math::scaled_by_power(mantissa, k) == std::ldexp(mantissa, int(k)));
  }
}

}  // namespace
}  // namespace rigc
