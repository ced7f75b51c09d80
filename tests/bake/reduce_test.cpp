// SPDX-License-Identifier: MIT
// Key reduction: fewer keys, no joint further off than was allowed, measured by another player.
#include "bake/reduce.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "bake_helpers.h"
#include "tests/math/random.h"

using namespace rigc;
using namespace rigc::bake;
using namespace rigc::bake::test;
using anim::Path;
using scene::NodeId;

namespace {

struct Chain {
  Stage stage;
  std::vector<NodeId> joints, controls;

  explicit Chain(int count) {
    NodeId parent, control;
    for (int i = 0; i < count; ++i) {
      parent = stage.joint("joint", parent, {{i == 0 ? 0.0 : 0.5, 0, 0}, {}, {1, 1, 1}});
      joints.push_back(parent);
    }
    for (const NodeId joint : joints)
      controls.push_back(control = stage.control_for(joint, control));
  }
};

/// Smooth random swings of every control.
anim::Clip swings(const Chain& chain, std::uint64_t seed) {
  rigc::test::Random random(seed);
  anim::Clip clip;
  for (const NodeId control : chain.controls) {
    const math::Vec3 axis = random.direction();
    const double size = random.between(0.2, 1), speed = random.between(1, 4);
    std::vector<float> times, values;
    for (int i = 0; i <= 60; ++i) {
      const double t = i / 60.0 * 2;
      const math::Quat q = math::axis_angle(axis, size * math::sin(speed * t));
      times.push_back(static_cast<float>(t));
      for (const double n : {q.x, q.y, q.z, q.w}) values.push_back(static_cast<float>(n));
    }
    clip.channels.push_back(channel(control, Path::rotation, times, values));
  }
  return clip;
}

double largest_error(const Chain& chain, const anim::Clip& clip, const anim::Clip& out) {
  double largest = 0;
  for (int frame = 0; frame <= 60; ++frame) {
    const double seconds = static_cast<double>(static_cast<float>(frame / 30.0));
    const auto truth = evaluated(chain.stage, clip, seconds);
    const auto shown = played(chain.stage, as_scene(chain.stage), out, seconds);
    for (const NodeId id : chain.joints)
      largest = std::max(largest, math::length(truth[id.index].origin - shown[id.index].origin));
  }
  return largest;
}

std::size_t key_count(const anim::Clip& clip) {
  std::size_t count = 0;
  for (const anim::Channel& c : clip.channels) count += c.curve.times->size();
  return count;
}

}  // namespace

TEST_CASE("bake reduce: the tolerance holds for every joint, and larger ones leave fewer keys") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Chain chain(5);
    const anim::Clip clip = swings(chain, seed);
    Report full_report;
    std::size_t before = key_count(baked(chain.stage, clip, {}, full_report));
    CHECK(before == full_report.keys);
    for (const double tolerance : {1e-4, 1e-3, 1e-2}) {
      Options options;
      options.tolerance = tolerance;
      Report report;
      const anim::Clip out = baked(chain.stage, clip, options, report);
      CHECK(report.reduction_error <= tolerance);
      CHECK(report.reduction_error > 0);
      CHECK(largest_error(chain, clip, out) <= tolerance + 1e-6);
      CHECK(key_count(out) < before);
      CHECK(report.keys == key_count(out));
      before = key_count(out);
    }
  }
}

TEST_CASE("bake reduce: a straight motion needs two keys") {
  const Chain chain(1);
  anim::Clip clip;
  clip.channels.push_back(
      channel(chain.controls[0], Path::translation, {0, 1}, {0, 0, 0, 1, 2, 3}));
  Options options;
  options.tolerance = 1e-4;
  Report report;
  const anim::Clip out = baked(chain.stage, clip, options, report);
  const anim::Channel* moved = find(out, chain.joints[0], Path::translation);
  REQUIRE(moved);
  CHECK(*moved->curve.times == std::vector<float>{0, 1});
  CHECK(moved->curve.values == std::vector<float>{0, 0, 0, 1, 2, 3});
}

TEST_CASE("bake reduce: the turning of a last joint is not thrown away") {
  const Chain chain(2);
  anim::Clip clip;
  const float s = 0.70710678f;
  clip.channels.push_back(channel(chain.controls[1], Path::rotation, {0, 0.5f, 1},
                                  {0, 0, 0, 1, s, 0, 0, s, 0, 0, 0, 1}));
  Options options;
  options.tolerance = 1e-3;
  Report report;
  const anim::Clip out = baked(chain.stage, clip, options, report);
  const auto truth = evaluated(chain.stage, clip, 0.5);
  const auto shown = played(chain.stage, as_scene(chain.stage), out, 0.5);
  CHECK(difference(truth[chain.joints[1].index], shown[chain.joints[1].index]) < 3e-3);
}

TEST_CASE("bake reduce: a tolerance that cannot be met keeps every frame") {
  const Chain chain(4);
  const anim::Clip clip = swings(chain, 9);
  Options options;
  options.tolerance = 1e-12;
  Report report, full_report;
  const anim::Clip out = baked(chain.stage, clip, options, report);
  CHECK(key_count(out) == key_count(baked(chain.stage, clip, {}, full_report)));
  CHECK(report.reduction_error < 1e-5);
}
