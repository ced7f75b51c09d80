// SPDX-License-Identifier: MIT
// Sampling against appendix C of the glTF 2.0 specification, written out again here.
#include "anim/clip.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/math/random.h"

namespace rigc {
namespace {

using anim::Curve;
using anim::Interpolation;
using test::Random;

Curve curve(Interpolation interpolation, int width, std::vector<float> times,
            std::vector<float> values) {
  Curve c;
  c.interpolation = interpolation;
  c.width = width;
  c.times = std::make_shared<const std::vector<float>>(std::move(times));
  c.values = std::move(values);
  return c;
}

double at(const Curve& c, double seconds) {
  double out = -1;
  anim::sample(c, false, seconds, &out);
  return out;
}

math::Quat rotation_at(const Curve& c, double seconds) {
  double q[4];
  anim::sample(c, true, seconds, q);
  return {q[0], q[1], q[2], q[3]};
}

TEST_CASE("anim sample: before the first and after the last key") {
  for (const auto kind : {Interpolation::step, Interpolation::linear}) {
    const Curve c = curve(kind, 1, {1, 2, 4}, {10, 20, 40});
    for (const double t : {-5.0, 0.0, 1.0}) CHECK(at(c, t) == 10);
    for (const double t : {4.0, 4.1, 1e9}) CHECK(at(c, t) == 40);
  }
  const Curve cubic = curve(Interpolation::cubic, 1, {1, 2}, {7, 10, 8, 9, 20, 6});
  CHECK(at(cubic, 0) == 10);
  CHECK(at(cubic, 3) == 20);
}

TEST_CASE("anim sample: a single key") {
  CHECK(at(curve(Interpolation::linear, 1, {3}, {5}), 0) == 5);
  CHECK(at(curve(Interpolation::step, 1, {3}, {5}), 3) == 5);
  CHECK(at(curve(Interpolation::cubic, 1, {3}, {1, 5, 2}), 9) == 5);
}

TEST_CASE("anim sample: keys are met exactly") {
  for (const auto kind : {Interpolation::step, Interpolation::linear}) {
    const Curve c = curve(kind, 1, {0.1f, 0.7f, 1.3f}, {0.3f, -0.9f, 0.1f});
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(at(c, static_cast<double>((*c.times)[i])) == static_cast<double>(c.values[i]));
    }
  }
}

TEST_CASE("anim sample: step holds and linear goes straight") {
  const Curve step = curve(Interpolation::step, 1, {0, 1, 3}, {1, 2, 3});
  CHECK(at(step, 0.999) == 1);
  CHECK(at(step, 1.0) == 2);
  CHECK(at(step, 2.999) == 2);
  const Curve linear = curve(Interpolation::linear, 3, {0, 2}, {0, 0, 0, 2, 4, -8});
  double v[3];
  anim::sample(linear, false, 0.5, v);
  CHECK(v[0] == 0.5);
  CHECK(v[1] == 1);
  CHECK(v[2] == -2);
}

TEST_CASE("anim sample: cubic as the specification writes it") {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    std::vector<float> values;
    for (int n = 0; n < 6; ++n) values.push_back(static_cast<float>(random.between(-2, 2)));
    const double first = random.between(0, 1), distance = random.between(0.1, 3);
    const Curve c =
        curve(Interpolation::cubic, 1,
              {static_cast<float>(first), static_cast<float>(first + distance)}, values);
    const double t0 = static_cast<double>((*c.times)[0]),
                 td = static_cast<double>((*c.times)[1]) - t0;
    const double t = random.between(0, 1);
    const double want = (2 * std::pow(t, 3) - 3 * t * t + 1) * static_cast<double>(values[1]) +
                        td * (std::pow(t, 3) - 2 * t * t + t) * static_cast<double>(values[2]) +
                        (-2 * std::pow(t, 3) + 3 * t * t) * static_cast<double>(values[4]) +
                        td * (std::pow(t, 3) - t * t) * static_cast<double>(values[3]);
    CHECK(at(c, t0 + t * td) == doctest::Approx(want).epsilon(1e-12));
  }
}

TEST_CASE("anim sample: cubic meets its keys and its tangents") {
  const Curve c = curve(Interpolation::cubic, 1, {0, 2, 3}, {0, 1, 0.5f, -0.25f, 3, 2, 0, 4, 0});
  CHECK(at(c, 2) == 3);
  const double h = 1e-6;
  CHECK((at(c, h) - at(c, 0)) / h == doctest::Approx(0.5).epsilon(1e-4));
  CHECK((at(c, 2) - at(c, 2 - h)) / h == doctest::Approx(-0.25).epsilon(1e-4));
  CHECK((at(c, 2 + h) - at(c, 2)) / h == doctest::Approx(2).epsilon(1e-4));
}

TEST_CASE("anim sample: rotations go the shorter way at constant speed") {
  // 10 to 350 degrees about Y: 20 degrees backwards.
  const auto key = [](double degrees) {
    return math::axis_angle({0, 1, 0}, math::radians(degrees));
  };
  const math::Quat a = key(10), b = key(350);
  std::vector<float> values;
  for (const double n : {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w})
    values.push_back(static_cast<float>(n));
  const Curve c = curve(Interpolation::linear, 4, {0, 1}, values);
  CHECK(test::distance(rotation_at(c, 0.5), key(0)) < 1e-7);
  CHECK(test::distance(rotation_at(c, 0.25), key(5)) < 1e-7);
}

TEST_CASE("anim sample: rotations come out at unit length") {
  Random random(2);
  for (const auto kind : {Interpolation::step, Interpolation::linear, Interpolation::cubic}) {
    for (int i = 0; i < 300; ++i) {
      std::vector<float> values;
      for (int n = 0; n < (kind == Interpolation::cubic ? 24 : 8); ++n) {
        values.push_back(static_cast<float>(random.between(-1, 1)));
      }
      const math::Quat q = rotation_at(curve(kind, 4, {0, 1}, values), random.between(-0.5, 1.5));
      CHECK(math::dot(q, q) == doctest::Approx(1).epsilon(1e-14));
    }
    const Curve zero = curve(kind, 4, {0, 1}, std::vector<float>(24, 0.0f));
    CHECK(rotation_at(zero, 0.5) == math::Quat{});
  }
}

TEST_CASE("anim clip: times of all channels") {
  anim::Clip clip;
  CHECK(anim::key_times(clip).empty());
  CHECK(anim::first_time(clip) == 0);
  CHECK(anim::last_time(clip) == 0);
  const auto shared = std::make_shared<const std::vector<float>>(std::vector<float>{0.5f, 1});
  for (int i = 0; i < 3; ++i) {
    anim::Channel channel;
    channel.curve.times = shared;
    clip.channels.push_back(channel);
  }
  anim::Channel other;
  other.curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0.25f, 1, 2});
  clip.channels.push_back(other);
  CHECK(anim::key_times(clip) == std::vector<double>{0.25, 0.5, 1, 2});
  CHECK(anim::first_time(clip) == 0.25);
  CHECK(anim::last_time(clip) == 2);
}

TEST_CASE("anim sampler: the same numbers as sample(), whatever the order of times") {
  Random random(12);
  for (const auto kind : {Interpolation::step, Interpolation::linear, Interpolation::cubic}) {
    for (const bool rotation : {false, true}) {
      std::vector<float> times, values;
      for (int i = 0; i < 20; ++i) {
        times.push_back(static_cast<float>(i) * 0.1f);
        for (int n = 0; n < (kind == Interpolation::cubic ? 12 : 4); ++n)
          values.push_back(static_cast<float>(random.between(-1, 1)));
      }
      const Curve c = curve(kind, 4, times, values);
      anim::Sampler rising(c, rotation), jumping(c, rotation);
      const auto check = [&](anim::Sampler& sampler, double seconds) {
        double wanted[4], got[4];
        anim::sample(c, rotation, seconds, wanted);
        sampler.at(seconds, got);
        for (int n = 0; n < 4; ++n) CHECK(got[n] == wanted[n]);
      };
      for (int i = -10; i < 250; ++i) check(rising, i * 0.01);
      for (const float time : times) check(rising, static_cast<double>(time));
      for (int i = 0; i < 100; ++i) check(jumping, random.between(-1, 3));
    }
  }
  const Curve one = curve(Interpolation::linear, 1, {3}, {5});
  CHECK(anim::Sampler(one, false).is_constant());
  CHECK_FALSE(anim::Sampler(curve(Interpolation::linear, 1, {3, 4}, {5, 5}), false).is_constant());
}

}  // namespace
}  // namespace rigc
