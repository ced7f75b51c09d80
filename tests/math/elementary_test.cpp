// SPDX-License-Identifier: MIT
// Own elementary functions against long double ones: the bounds stated in the sources, and finite
// results.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/math/random.h"

namespace rigc {
namespace {

using test::Random;

// Difference in units of the last place of the true value.
double ulps(double got, long double want) {
  const double rounded = std::fabs(static_cast<double>(want));
  const double unit = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return static_cast<double>(std::fabs(static_cast<long double>(got) - want) /
                             static_cast<long double>(unit));
}

template <class Own, class Wanted, class Draw>
double worst(Own own, Wanted wanted, Draw draw, int count = 200000) {
  double most = 0;
  for (int i = 0; i < count; ++i) {
    const double x = draw();
    const double off = ulps(own(x), wanted(static_cast<long double>(x)));
    if (off > most) most = off;
  }
  return most;
}

const long double kPiLong = 3.141592653589793238462643383279502884L;

TEST_CASE("math elementary: sine, cosine and tangent") {
  Random random(1);
  const auto sine = [](long double x) { return sinl(x); };
  const auto cosine = [](long double x) { return cosl(x); };
  const auto tangent = [](long double x) { return tanl(x); };
  for (const double range : {1e-8, 0.5, 0.79, 3.2, 100.0, 1e6}) {
    CAPTURE(range);
    const auto draw = [&] { return random.between(-range, range); };
    CHECK(worst(math::sin, sine, draw) < 1.0);
    CHECK(worst(math::cos, cosine, draw) < 1.0);
    CHECK(worst(math::tan, tangent, draw) < 2.5);
  }
}

TEST_CASE("math elementary: near multiples of a quarter turn") {
  const double half_pi = math::kPi / 2;
  for (int n = 1; n < 600000; n += 7) {
    const double x = n * half_pi;
    REQUIRE(ulps(math::sin(x), sinl(static_cast<long double>(x))) < 1.0);
    REQUIRE(ulps(math::cos(x), cosl(static_cast<long double>(x))) < 1.0);
  }
}

TEST_CASE("math elementary: degrees are exact at quarter turns") {
  const double sines[] = {0, 1, 0, -1};
  for (int n = -40; n <= 40; ++n) {
    const int quarter = ((n % 4) + 4) % 4;
    CHECK(math::sin_degrees(n * 90.0) == sines[quarter]);
    CHECK(math::cos_degrees(n * 90.0) == sines[(quarter + 1) % 4]);
    CHECK(!std::signbit(math::sin_degrees(n * 180.0)));
    CHECK(math::tan_degrees(n * 90.0) == 0);
  }
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const double x = random.between(-720, 720);
    const long double exact = sinl(static_cast<long double>(x) * kPiLong / 180);
    REQUIRE(std::fabs(static_cast<double>(static_cast<long double>(math::sin_degrees(x)) - exact)) <
            3e-16);
  }
}

TEST_CASE("math elementary: arc tangent, sine and cosine") {
  Random random(3);
  const auto arc_tangent = [](long double x) { return atanl(x); };
  for (const double range : {1e-8, 0.06, 1.0, 10.0, 1e10}) {
    CAPTURE(range);
    const auto draw = [&] { return random.between(-range, range); };
    CHECK(worst(math::atan, arc_tangent, draw) < 2.0);
  }
  const auto draw = [&] { return random.between(-1, 1); };
  CHECK(worst(
            math::asin, [](long double x) { return asinl(x); }, draw) < 3.0);
  CHECK(worst(
            math::acos, [](long double x) { return acosl(x); }, draw) < 3.0);
  for (int i = 0; i < 200000; ++i) {
    const double y = random.between(-1, 1), x = random.between(-1, 1);
    REQUIRE(ulps(math::atan2(y, x),
                 atan2l(static_cast<long double>(y), static_cast<long double>(x))) < 2.0);
  }
}

TEST_CASE("math elementary: arc tangent on the axes") {
  const double pi = math::kPi;
  CHECK(math::atan2(0, 0) == 0);
  CHECK(math::atan2(0, 1) == 0);
  CHECK(math::atan2(0, -1) == pi);
  CHECK(math::atan2(-0.0, -1) == -pi);
  CHECK(math::atan2(1, 0) == pi / 2);
  CHECK(math::atan2(-1, 0) == -pi / 2);
  CHECK(math::atan2(1, 1) == pi / 4);
  CHECK(math::atan2(1e-320, 1e300) == 0);
  CHECK(math::asin(2) == pi / 2);
  CHECK(math::acos(2) == 0);
  CHECK(math::acos(-2) == pi);
}

TEST_CASE("math elementary: exponential, logarithm and cube root") {
  Random random(4);
  const auto exponential = [](long double x) { return expl(x); };
  const auto logarithm = [](long double x) { return logl(x); };
  for (const double range : {1e-8, 0.4, 1.0, 50.0, 700.0}) {
    CAPTURE(range);
    const auto draw = [&] { return random.between(-range, range); };
    CHECK(worst(math::exp, exponential, draw) < 1.0);
  }
  CHECK(worst(math::log, logarithm, [&] { return random.between(0.5, 2.0); }) < 1.0);
  CHECK(worst(math::log, logarithm, [&] { return random.any_size(1000, 1); }) < 1.0);
  CHECK(worst(
            math::cbrt, [](long double x) { return cbrtl(x); },
            [&] { return random.any_size(1000, 0); }) < 1.0);
  CHECK(math::cbrt(27) == 3);
  CHECK(math::cbrt(-1e-6) == doctest::Approx(-0.01));
  CHECK(math::exp(0) == 1);
  CHECK(math::log(1) == 0);
}

TEST_CASE("math elementary: power") {
  Random random(5);
  for (int i = 0; i < 200000; ++i) {
    const double x = random.any_size(20, 1);
    const double y = random.between(-20, 20);
    const long double want = powl(static_cast<long double>(x), static_cast<long double>(y));
    const double bound = 1.0 + std::fabs(y * std::log(x)) / 32;
    REQUIRE(ulps(math::pow(x, y), want) < bound);
  }
  CHECK(math::pow(3, 2) == 9);
  CHECK(math::pow(-3, 3) == -27);
  CHECK(math::pow(-2, -2) == 0.25);
  CHECK(math::pow(-8, 0.5) == 0);
  CHECK(math::pow(0, 0) == 1);
  CHECK(math::pow(0, -1) == 0);
  CHECK(math::pow(2, 10) == 1024);
  CHECK(math::pow(4, 0.5) == 2);
}

TEST_CASE("math elementary: every argument gives a finite number") {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double odd[] = {0,     -0.0, 1,    -1,  0.5,    -0.5,    1e-320, -1e-320, 1e308, -1e308,
                        1e300, inf,  -inf, nan, 5e-324, 1e6 + 1, 3e15,   -7e200,  710,   -746};
  for (const double x : odd) {
    CAPTURE(x);
    for (const auto f : {math::sqrt, math::cbrt, math::sin, math::cos, math::tan, math::atan,
                         math::asin, math::acos, math::exp, math::log, math::sin_degrees,
                         math::cos_degrees, math::tan_degrees}) {
      CHECK(std::isfinite(f(x)));
    }
    for (const double y : odd) {
      CAPTURE(y);
      CHECK(std::isfinite(math::pow(x, y)));
      CHECK(std::isfinite(math::atan2(x, y)));
    }
    CHECK(std::fabs(math::sin(x)) <= 1);
  }
}

}  // namespace
}  // namespace rigc
