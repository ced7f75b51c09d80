// SPDX-License-Identifier: MIT
// Bakes at the keys' own times: frames are added where playing between keys needs them.
#include "bake/insert.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "bake_helpers.h"

using namespace rigc;
using namespace rigc::bake;
using namespace rigc::bake::test;
using anim::Path;
using scene::NodeId;

namespace {

struct Pair {
  Stage stage;
  NodeId upper, lower, upper_control, lower_control;

  Pair() {
    upper = stage.joint("upper", {}, {{0, 1, 0}, {}, {1, 1, 1}});
    lower = stage.joint("lower", upper, {{0.5, 0, 0}, {}, {1, 1, 1}});
    upper_control = stage.control_for(upper);
    lower_control = stage.control_for(lower, upper_control);
  }

  double error(const anim::Clip& clip, const anim::Clip& out, double end) const {
    double largest = 0;
    for (int i = 0; i <= 500; ++i) {
      const double seconds = end * i / 500;
      const auto truth = evaluated(stage, clip, seconds);
      const auto shown = played(stage, as_scene(stage), out, seconds);
      for (const NodeId id : {upper, lower})
        largest = std::max(largest, math::length(truth[id.index].origin - shown[id.index].origin));
    }
    return largest;
  }
};

std::vector<float> turns(std::initializer_list<double> radians) {
  std::vector<float> out;
  for (const double angle : radians) {
    const math::Quat q = math::axis_angle({0, 0, 1}, angle);
    for (const double n : {q.x, q.y, q.z, q.w}) out.push_back(static_cast<float>(n));
  }
  return out;
}

Options at_keys(double tolerance) {
  Options options;
  options.fps = 0;
  options.tolerance = tolerance;
  return options;
}

/// Two keys a second apart with steep tangents.
anim::Clip curved(const Pair& pair) {
  anim::Clip clip;
  clip.channels.push_back(channel(pair.upper_control, Path::translation, {0, 1},
                                  {0, 0, 0, 0, 0, 0, 4, 2, 0, 0, 0, -3, 1, 0, 0, 0, 0, 0},
                                  anim::Interpolation::cubic));
  return clip;
}

}  // namespace

TEST_CASE("bake insert: without a tolerance the frames are the keys' times") {
  const Pair pair;
  Report report;
  baked(pair.stage, curved(pair), at_keys(0), report);
  CHECK(report.frames == 2);
}

TEST_CASE("bake insert: a curve between two keys gets the frames that the tolerance needs") {
  const Pair pair;
  const anim::Clip clip = curved(pair);
  std::size_t before = 2;
  for (const double tolerance : {0.05, 0.01, 0.001}) {
    Report report;
    const anim::Clip out = baked(pair.stage, clip, at_keys(tolerance), report);
    CHECK(report.frames > before);
    CHECK(pair.error(clip, out, 1) <= tolerance);
    before = report.frames;
  }
  CHECK(before < 300);
}

TEST_CASE("bake insert: what plays between its keys as it should gets none") {
  const Pair pair;
  anim::Clip clip;
  clip.channels.push_back(
      channel(pair.upper_control, Path::translation, {0, 2}, {0, 0, 0, 1, 2, 3}));
  Report report;
  baked(pair.stage, clip, at_keys(1e-4), report);
  CHECK(report.frames == 2);
}

TEST_CASE("bake insert: a turn of the whole chain by more than a half goes the right way round") {
  const Pair pair;
  anim::Clip clip;
  // Each control turns by 120 degrees; the joint below them by 240 in its own space.
  clip.channels.push_back(channel(pair.upper_control, Path::rotation, {0, 1}, turns({0, 2.1})));
  clip.channels.push_back(channel(pair.lower_control, Path::rotation, {0, 1}, turns({0, 2.1})));
  Options options = at_keys(0.001);
  options.standings = as_scene(pair.stage);
  options.standings[pair.lower.index].base = {};  // in the file it hangs under nothing
  Report report;
  const anim::Clip out = baked(pair.stage, clip, options, report);
  CHECK(report.frames > 2);
  for (const double seconds : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const auto truth = evaluated(pair.stage, clip, seconds);
    const auto shown = played(pair.stage, options.standings, out, seconds);
    CHECK(difference(truth[pair.lower.index], shown[pair.lower.index]) < 0.01);
  }
}

TEST_CASE("bake insert: steps stay steps") {
  const Pair pair;
  anim::Clip clip;
  clip.channels.push_back(channel(pair.upper_control, Path::translation, {0, 0.5f, 1, 2},
                                  {0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 2, 0}, anim::Interpolation::step));
  for (const double tolerance : {0.0, 1e-4}) {
    Report report;
    const anim::Clip out = baked(pair.stage, clip, at_keys(tolerance), report);
    // A frame before each key whose value is new.
    CHECK(report.frames == 6);
    CHECK(pair.error(clip, out, 1.99) < 1e-6);
    const double before = std::nextafter(0.5f, 0.0f);
    for (const double seconds : {before, 0.5}) {
      const auto shown = played(pair.stage, as_scene(pair.stage), out, seconds);
      CHECK(shown[pair.upper.index].origin.x == (seconds < 0.5 ? 0 : 1));
    }
  }
}

TEST_CASE("bake insert: motion that jumps within a gap ends") {
  Pair pair;
  anim::Clip clip;
  // The second control swings round while its key times are far apart.
  clip.channels.push_back(channel(pair.upper_control, Path::rotation, {0, 1000}, turns({0, 3.1})));
  Report report;
  baked(pair.stage, clip, at_keys(1e-7), report);
  CHECK(report.frames >= 2);
}
