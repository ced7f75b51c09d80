// SPDX-License-Identifier: MIT
// New keys in a range of a curve: outside it plays what it played.
#include <doctest/doctest.h>

#include <cmath>

#include "bake/key_edit.h"

using namespace rigc;

namespace {

anim::Curve curve(anim::Interpolation interpolation, std::vector<float> values) {
  anim::Curve out;
  out.interpolation = interpolation;
  out.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1, 3});
  out.values = std::move(values);
  return out;
}

double at(const anim::Curve& of, double seconds) {
  double value = 0;
  anim::sample(of, false, seconds, &value);
  return value;
}

const std::vector<double> kOutside{0, 0.3, 0.7, 0.7999, 1.8001, 2, 2.5, 3, 4};

double f(double seconds) { return static_cast<double>(static_cast<float>(seconds)); }

}  // namespace

TEST_CASE("bake key edit: every interpolation keeps what is outside of the range") {
  using anim::Interpolation;
  for (const anim::Curve& old :
       {curve(Interpolation::linear, {1, 5, 2}), curve(Interpolation::step, {1, 5, 2}),
        curve(Interpolation::cubic, {0, 1, 2, 3, 5, -1, 4, 2, 0})}) {
    CAPTURE(static_cast<int>(old.interpolation));
    for (const bool steps : {false, true}) {
      CAPTURE(steps);
      bake::KeyEdit edit{&old, false, {0}, {f(0.8), f(1.2), f(1.8)}, {10, 20, -4}};
      edit.steps = steps;
      const anim::Curve now = bake::edited(edit);
      for (std::size_t i = 0; i < 3; ++i) CHECK(at(now, edit.times[i]) == edit.values[i]);
      for (const double time : kOutside)
        CHECK(at(now, time) == doctest::Approx(at(old, time)).epsilon(1e-5));
      CHECK(at(now, 1) == doctest::Approx(steps ? 10 : 15).epsilon(1e-5));
      CHECK(at(now, 1.79) == doctest::Approx(steps ? 20 : -3.6).epsilon(1e-5));
    }
  }
}

TEST_CASE("bake key edit: steps stay steps wherever a curve can have them") {
  using anim::Interpolation;
  const anim::Curve blocked = curve(Interpolation::step, {1, 5, 2});
  const anim::Curve smooth = curve(Interpolation::cubic, {0, 1, 2, 3, 5, -1, 4, 2, 0});
  for (const anim::Curve* old : {static_cast<const anim::Curve*>(nullptr), &blocked, &smooth}) {
    bake::KeyEdit edit{old, false, {7}, {0, 1, 3}, {10, 20, -4}, true, true, true};
    const anim::Curve whole = bake::edited(edit);
    CHECK(whole.interpolation == Interpolation::step);
    CHECK(whole.values == std::vector<float>{10, 20, -4});
    edit.opens = edit.closes = false;
    CHECK((bake::edited(edit).interpolation == Interpolation::step) == (old != &smooth));
  }
}

TEST_CASE("bake key edit: a curve that was not there gives its rest outside") {
  const bake::KeyEdit edit{nullptr, false, {7}, {f(0.8), f(1.8)}, {10, 20}};
  const anim::Curve now = bake::edited(edit);
  for (const double time : kOutside) CHECK(at(now, time) == 7);
  CHECK(at(now, edit.times[1]) == 20);
}

TEST_CASE("bake key edit: the whole clip gets no other keys, and one where nothing moves") {
  const anim::Curve old = curve(anim::Interpolation::linear, {1, 5, 2});
  bake::KeyEdit edit{&old, false, {0}, {0, 1, 2, 3}, {3, 4, 5, 6}, true, true};
  CHECK(bake::edited(edit).values == std::vector<float>{3, 4, 5, 6});
  edit.values = {2, 2, 2, 2};
  CHECK(bake::edited(edit).values == std::vector<float>{2});
}

TEST_CASE("bake key edit: a rotation goes on the near way") {
  anim::Curve old;
  old.width = 4;
  old.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 3});
  old.values = {0, 0, 0, 1, 0, 0, 0, 1};
  const bake::KeyEdit edit{&old, true, {0, 0, 0, 1}, {1, 2}, {0, 0, 0, -1, 0, 0.6, 0, -0.8}};
  const anim::Curve now = bake::edited(edit);
  REQUIRE(now.times->size() == 6);
  CHECK(now.values[4 * 2 + 3] == 1);
  CHECK(now.values[4 * 3 + 3] == doctest::Approx(0.8));
}

TEST_CASE("bake key edit: a cubic rotation is cut at keys of length 1 and turns as it did") {
  // Keys far apart and tangents beside them: the numbers between are as short as 0.8.
  anim::Curve old;
  old.interpolation = anim::Interpolation::cubic;
  old.width = 4;
  old.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1, 2});
  old.values = {0,    0, 0, 0, 0,    0,    0, 1,    0.3f, 0.2f, 0, 0,  //
                0.1f, 0, 0, 0, 0.8f, 0,    0, 0.6f, 0,    0.4f, 0, 0,  //
                0,    0, 0, 0, 0,    0.6f, 0, 0.8f, 0,    0,    0, 0};
  const bake::KeyEdit edit{&old, true, {0, 0, 0, 1}, {f(0.6), f(1.4)}, {0, 0, 0, 1, 0, 0, 0, 1}};
  const anim::Curve now = bake::edited(edit);
  for (std::size_t i = 0; i < now.times->size(); ++i) {
    double squares = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto number = static_cast<double>(now.values[4 * (3 * i + 1) + k]);
      squares += number * number;
    }
    CHECK(std::abs(std::sqrt(squares) - 1) < 1e-4);
  }
  for (double time = 0; time <= 2; time += 0.01) {
    if (time > 0.59 && time < 1.41) continue;
    double a[4], b[4];
    anim::sample(old, true, time, a);
    anim::sample(now, true, time, b);
    for (int k = 0; k < 4; ++k) CHECK(std::abs(a[k] - b[k]) < 1e-6);
  }
}
