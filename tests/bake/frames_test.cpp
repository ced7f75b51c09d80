// SPDX-License-Identifier: MIT
// Times of frames: exact, rising, up to the end.
#include "bake/frames.h"

#include <doctest/doctest.h>

#include <limits>

#include "bake/codes.h"
#include "bake_helpers.h"

using namespace rigc;
using namespace rigc::bake;
using namespace rigc::bake::test;

namespace {

anim::Clip clip_at(std::vector<float> times) {
  anim::Clip clip;
  std::vector<float> values(times.size() * 3, 0.0f);
  clip.channels.push_back(
      channel({0}, anim::Path::translation, std::move(times), std::move(values)));
  return clip;
}

std::optional<std::vector<double>> times_of(const anim::Clip& clip, const Options& options,
                                            Diagnostics& diagnostics) {
  return frame_times(clip, clip, options, 22, diagnostics);
}

std::vector<double> good_times(const anim::Clip& clip, const Options& options) {
  Diagnostics diagnostics;
  const auto times = times_of(clip, options, diagnostics);
  REQUIRE(times);
  return *times;
}

Options with_fps(double fps) {
  Options options;
  options.fps = fps;
  return options;
}

}  // namespace

TEST_CASE("bake frames: a grid from the start, exact") {
  const auto times = good_times(clip_at({0, 1}), with_fps(30));
  REQUIRE(times.size() == 31);
  for (std::size_t k = 0; k < times.size(); ++k)
    CHECK(times[k] == static_cast<double>(static_cast<float>(static_cast<double>(k) / 30)));
}

TEST_CASE("bake frames: the end is there also off the grid, and once") {
  const auto off = good_times(clip_at({0, 0.51f}), with_fps(10));
  REQUIRE(off.size() == 7);
  CHECK(off[5] == 0.5);
  CHECK(off[6] == static_cast<double>(0.51f));
  // 250 / 30 is no float: the end lies a hair beside the grid.
  const auto rounded = good_times(clip_at({0, static_cast<float>(250 / 30.0)}), with_fps(30));
  CHECK(rounded.size() == 251);
  const auto tenth = good_times(clip_at({0, 0.1f}), with_fps(30));
  CHECK(tenth.size() == 4);
}

TEST_CASE("bake frames: start and end may be chosen") {
  Options options = with_fps(4);
  options.start = 0.3;
  options.end = 1;
  const auto times = good_times(clip_at({0, 5}), options);
  REQUIRE(times.size() == 4);
  CHECK(times[0] == doctest::Approx(0.3));
  CHECK(times[1] == doctest::Approx(0.55));
  CHECK(times[3] == 1);
  options.end = 0.3;
  CHECK(good_times(clip_at({0, 5}), options).size() == 1);
}

TEST_CASE("bake frames: a clip that begins later begins there, one of one key has one frame") {
  CHECK(good_times(clip_at({2, 3}), with_fps(2)) == std::vector<double>{2, 2.5, 3});
  CHECK(good_times(clip_at({2}), with_fps(2)) == std::vector<double>{2});
}

TEST_CASE("bake frames: source takes the keys' own times within the range") {
  Options options = with_fps(0);
  options.start = 0.5;
  const auto times = good_times(clip_at({0, 0.25f, 0.75f, 2}), options);
  CHECK(times == std::vector<double>{0.5, 0.75, 2});
}

TEST_CASE("bake frames: times are different floats") {
  Options options = with_fps(100000);
  options.start = 1000;
  options.end = 1000.01;
  const auto times = good_times(clip_at({0, 2000}), options);
  CHECK(times.size() > 100);
  CHECK(times.size() < 1000);
  for (std::size_t i = 1; i < times.size(); ++i)
    CHECK(static_cast<float>(times[i]) > static_cast<float>(times[i - 1]));
  CHECK(times.back() == static_cast<double>(1000.01f));
}

TEST_CASE("bake frames: impossible ranges are errors") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  struct Range {
    double start, end, fps;
  };
  for (const Range range : {Range{2, 1, 30}, Range{-1, 1, 30}, Range{0, nan, 30}, Range{nan, 1, 30},
                            Range{0, infinite, 30}, Range{0, 1, -1}}) {
    Options options = with_fps(range.fps);
    options.start = range.start;
    options.end = range.end;
    Diagnostics diagnostics;
    CHECK_FALSE(times_of(clip_at({0, 1}), options, diagnostics));
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code == &codes::kRange);
  }
}

TEST_CASE("bake frames: more than fits into memory is an error") {
  Options options = with_fps(1000);
  options.end = 2000;
  Diagnostics diagnostics;
  CHECK_FALSE(times_of(clip_at({0, 1}), options, diagnostics));
  REQUIRE(diagnostics.errors() == 1);
  CHECK(diagnostics.all()[0].code == &codes::kTooLong);
}
