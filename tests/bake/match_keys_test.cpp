// SPDX-License-Identifier: MIT
// Between the keys of a match a limb plays what it played; what was blocked stays blocked.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "bake/match_helpers.h"
#include "bake/match_keys.h"
#include "support/models.h"

using namespace rigc;
using test::Keys;

namespace {

using anim::Interpolation;

constexpr double kMillimetre = 1e-3;

std::vector<double> about(math::Vec3 axis, double degrees) {
  const math::Quat q = math::axis_angle(math::normalised(axis), math::radians(degrees));
  return {q.x, q.y, q.z, q.w};
}

/// Turns a control to one angle after another, at 0, 1, 2, 3 seconds.
void turn(const test::Rig& rig, anim::Clip& clip, const std::string& control, math::Vec3 axis,
          std::vector<double> degrees, Interpolation interpolation) {
  Keys keys(rig, {0, 1, 2, 3});
  std::size_t at = 0;
  keys.add(control + "@rotation", 4, [&] { return about(axis, degrees[at++]); });
  keys.clip.channels.back().curve.interpolation = interpolation;
  clip.channels.push_back(keys.clip.channels.back());
}

/// An arm that swings and bends in FK.
anim::Clip swing(const test::Rig& rig, Interpolation interpolation) {
  anim::Clip clip;
  const std::string fk = "/ik_fk_limb.fk";
  turn(rig, clip, "arm_l.upper" + fk, {1, 0, 1}, {0, 100, -40, 20}, interpolation);
  turn(rig, clip, "arm_l.lower" + fk, {0, 1, 0}, {-20, -100, -10, -60}, interpolation);
  turn(rig, clip, "arm_l.end" + fk, {0, 1, 1}, {0, 40, -50, 0}, interpolation);
  return clip;
}

struct Matching {
  bake::MatchTiming when;
  double tolerance = kMillimetre;
  bool to_ik = true;
};

struct Outcome {
  anim::Clip clip;
  bake::MatchReport report;
};

Outcome match(const test::Rig& rig, const anim::Clip& clip, const Matching& how) {
  const auto nodes = test::nodes_of(rig.scene());
  const auto limbs = bake::find_match_limbs(rig.scene());
  const bake::MatchLimb& limb = test::find(limbs, "arm_l");
  Diagnostics diagnostics;
  bake::MatchTask task{rig.scene(), nodes, clip, clip, how.when, how.tolerance, {}, {}};
  task.solve = [&](const bake::MatchOptions& options) {
    return bake::solve_match(rig.scene(), nodes, clip, limb, options, diagnostics);
  };
  bake::MatchOptions options;
  options.to_ik = how.to_ik;
  Outcome out;
  auto matched = bake::match_keys(task, options, out.report, diagnostics);
  REQUIRE_MESSAGE(matched, test::text(diagnostics));
  out.clip = std::move(*matched);
  return out;
}

/// How far the arm of one clip is from that of another, at many times from one to another.
double apart(const test::Rig& rig, const anim::Clip& a, const anim::Clip& b, double from = 0,
             double to = 3) {
  const auto limbs = bake::find_match_limbs(rig.scene());
  const bake::MatchLimb& limb = test::find(limbs, "arm_l");
  double off = 0;
  for (int i = 0; i <= 400; ++i) {
    const double time = from + (to - from) * i / 400;
    const auto p = test::joints_at(rig, limb, a, time), q = test::joints_at(rig, limb, b, time);
    for (std::size_t j = 0; j < 3; ++j)
      off = std::max(off, test::distance(p[j].origin, q[j].origin));
  }
  return off;
}

/// Channels of the one that the other has not.
std::vector<const anim::Channel*> new_channels(const anim::Clip& now, const anim::Clip& before) {
  std::vector<const anim::Channel*> out;
  for (std::size_t i = before.channels.size(); i < now.channels.size(); ++i)
    out.push_back(&now.channels[i]);
  return out;
}

}  // namespace

TEST_CASE("bake match keys: between keys the arm is within the tolerance, both ways") {
  const test::Rig rig(test::arms());
  REQUIRE(rig.clean());
  const anim::Clip clip = swing(rig, Interpolation::linear);
  const Outcome bare = match(rig, clip, {{}, 0});
  CHECK(bare.report.inserted == 0);
  CHECK(bare.report.between.distance > 50 * kMillimetre);  // and says so
  CHECK(apart(rig, clip, bare.clip) == doctest::Approx(bare.report.between.distance).epsilon(0.2));

  const Outcome to_ik = match(rig, clip, {});
  CHECK(to_ik.report.inserted > 10);
  CHECK(to_ik.report.frames == 4 + to_ik.report.inserted);
  CHECK(to_ik.report.at_keys.distance < 1e-6);
  CHECK(to_ik.report.between.distance < kMillimetre);
  CHECK(apart(rig, clip, to_ik.clip) < kMillimetre);
  const Outcome back = match(rig, to_ik.clip, {{}, kMillimetre, false});
  CHECK(apart(rig, to_ik.clip, back.clip) < kMillimetre);

  const Outcome fine = match(rig, clip, {{}, kMillimetre / 20});
  CHECK(fine.report.inserted > 2 * to_ik.report.inserted);
  CHECK(apart(rig, clip, fine.clip) < kMillimetre / 20);
  const Outcome frames = match(rig, clip, {{10, {}, {}}, kMillimetre});
  CHECK(frames.report.frames == 31);
  CHECK(frames.report.inserted == 0);
}

TEST_CASE("bake match keys: a blocked arm stays blocked, in all of it and in a range") {
  const test::Rig rig(test::arms());
  const anim::Clip clip = swing(rig, Interpolation::step);
  const Outcome whole = match(rig, clip, {});
  CHECK(whole.report.frames == 4);
  CHECK(apart(rig, clip, whole.clip) < 1e-6);
  CHECK(new_channels(whole.clip, clip).size() >= 4);
  for (const anim::Channel* channel : new_channels(whole.clip, clip))
    CHECK(channel->curve.interpolation == Interpolation::step);
  const Outcome part = match(rig, clip, {{0, 0.5, 2.25}});
  CHECK(part.report.inserted == 0);
  CHECK(apart(rig, clip, part.clip) < 1e-6);
  const Outcome back = match(rig, part.clip, {{0, 0.25, 2.75}, kMillimetre, false});
  CHECK(apart(rig, clip, back.clip) < 1e-6);
}

TEST_CASE("bake match keys: lines elsewhere do not unblock an arm, those that carry it do") {
  const test::Rig rig(test::arms());
  anim::Clip clip = swing(rig, Interpolation::step);
  turn(rig, clip, "arm_r.upper/ik_fk_limb.fk", {0, 0, 1}, {0, 30, 10, 50}, Interpolation::linear);
  const Outcome alone = match(rig, clip, {});
  CHECK(alone.report.inserted == 0);
  CHECK(apart(rig, clip, alone.clip) < 1e-6);
  for (const anim::Channel* channel : new_channels(alone.clip, clip))
    CHECK(channel->curve.interpolation == Interpolation::step);

  turn(rig, clip, "torso.chest/control", {0, 1, 0}, {0, 60, -60, 0}, Interpolation::linear);
  const Outcome carried = match(rig, clip, {});
  CHECK(carried.report.inserted > 10);
  CHECK(apart(rig, clip, carried.clip) < kMillimetre);
  for (const double step : {1.0, 2.0, 3.0})  // which lines do not smear
    CHECK(apart(rig, clip, carried.clip, step - 1e-3, step) < kMillimetre);
  const Outcome part = match(rig, clip, {{0, 0.5, 2.25}});
  CHECK(apart(rig, clip, part.clip) < kMillimetre);
}

TEST_CASE("bake match keys: a blocked IK arm whose keys are replaced is keyed by lines as needed") {
  const test::Rig rig(test::arms());
  anim::Clip clip = swing(rig, Interpolation::linear);
  Keys keys(rig, {0, 1, 2, 3});
  test::Random random(4);
  keys.translate("arm_l/ik_fk_limb.ik", random, 0.2);
  keys.clip.channels.back().curve.interpolation = Interpolation::step;
  clip.channels.push_back(keys.clip.channels.back());
  for (const Matching& how : {Matching{}, Matching{{0, 0.5, 2.25}}}) {
    const Outcome now = match(rig, clip, how);
    CHECK(apart(rig, clip, now.clip) < kMillimetre);
  }
}
