// SPDX-License-Identifier: MIT
// Transfers on scenes made by hand: what comes, what goes, and how exactly it plays the same.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bake/transfer.h"
#include "bake/transfer_limb.h"
#include "bake_helpers.h"

namespace rigc::bake {
namespace {

using anim::Interpolation;
using anim::Path;
using scene::NodeId;
using test::Stage;

/// Three joints, one under the other, the first two with controls that follow each other.
struct Arm {
  Stage stage;
  NodeId upper, lower, hand, upper_control, lower_control;

  Arm() {
    upper = stage.joint("upper", {}, {{0.2, 1.4, 0}, math::axis_angle({0, 0, 1}, -1.2), {1, 1, 1}});
    lower = stage.joint("lower", upper, {{0, 0.3, 0}, math::axis_angle({1, 0, 0}, 0.3), {1, 1, 1}});
    hand = stage.joint("hand", lower, {{0, 0.25, 0}, {}, {1, 1, 1}});
    upper_control = stage.control_for(upper);
    lower_control = stage.control_for(lower, upper_control);
  }
};

anim::Clip clip_of(std::vector<anim::Channel> channels) {
  anim::Clip clip{"clip", 0, std::move(channels)};
  for (std::size_t i = 0; i < clip.channels.size(); ++i)
    clip.channels[i].source_channel = static_cast<int>(i);
  return clip;
}

Transferred transferred(const Stage& stage, const anim::Clip& clip, const TransferOptions& options,
                        TransferReport& report) {
  Diagnostics diagnostics;
  auto out = transfer(stage.scene, stage.nodes(), clip, options, report, diagnostics);
  REQUIRE_MESSAGE(out, render(diagnostics, false));
  return std::move(*out);
}

/// The clip after a transfer, as a file would have it.
anim::Clip applied(const anim::Clip& clip, const Transferred& change) {
  anim::Clip out = change.clip;
  for (const anim::Channel& c : clip.channels) {
    const auto& dropped = change.dropped;
    const bool gone =
        std::find(dropped.begin(), dropped.end(), c.source_channel) != dropped.end() ||
        test::find(change.clip, {static_cast<std::uint32_t>(c.node)}, c.path);
    if (!gone) out.channels.push_back(c);
  }
  return out;
}

std::vector<float> random_turns(std::mt19937_64& random, std::size_t count) {
  std::vector<float> values;
  for (std::size_t i = 0; i < count; ++i) {
    double q[4];
    for (double& x : q) x = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
    const math::Quat turn = math::normalised(math::Quat{q[0], q[1], q[2], q[3]});
    for (const double x : {turn.x, turn.y, turn.z, turn.w}) values.push_back(static_cast<float>(x));
  }
  return values;
}

std::vector<float> random_places(std::mt19937_64& random, std::size_t count) {
  std::vector<float> values;
  for (std::size_t i = 0; i < count * 3; ++i)
    values.push_back(static_cast<float>(static_cast<double>(random() >> 11) * 0x1p-52 - 1));
  return values;
}

/// Largest difference between what a clip on joints plays and what its transfer evaluates.
double difference_at(const Arm& arm, const std::vector<Standing>& standings, const anim::Clip& clip,
                     const anim::Clip& on_controls, double seconds) {
  const auto wanted = test::played(arm.stage, standings, clip, seconds);
  const auto got = test::evaluated(arm.stage, on_controls, seconds);
  double largest = 0;
  for (const NodeId id : {arm.upper, arm.lower, arm.hand})
    largest = std::max(largest, test::difference(wanted[id.index], got[id.index]));
  return largest;
}

const std::vector<float> kTimes{0, 0.5f, 0.75f, 2};

}  // namespace

TEST_CASE("bake transfer: random motion of joints comes back from their controls") {
  std::mt19937_64 random(3);
  const Arm arm;
  const anim::Clip clip =
      clip_of({test::channel(arm.upper, Path::rotation, kTimes, random_turns(random, 4)),
               test::channel(arm.upper, Path::translation, kTimes, random_places(random, 4)),
               test::channel(arm.lower, Path::rotation, {0.25f, 1}, random_turns(random, 2)),
               test::channel(arm.lower, Path::translation, kTimes, random_places(random, 4))});
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, {}, report);
  CHECK(report.joints == 2);
  CHECK(report.controls == 2);
  CHECK(report.frames == 6);  // of all keys
  CHECK(change.dropped == std::vector<int>{0, 1, 2, 3});
  CHECK(report.at_keys.distance < 1e-6);
  CHECK(report.at_keys.angle < 1e-6);
  const anim::Clip on_controls = applied(clip, change);
  for (const anim::Channel& c : on_controls.channels) {
    const NodeId node{static_cast<std::uint32_t>(c.node)};
    CHECK((node == arm.upper_control || node == arm.lower_control));
  }
  for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0, 2.0})
    CHECK(difference_at(arm, test::as_scene(arm.stage), clip, on_controls, time) < 1e-6);
}

TEST_CASE("bake transfer: joints that stand elsewhere in their file than at rest") {
  std::mt19937_64 random(5);
  const Arm arm;
  std::vector<Standing> standings = test::as_scene(arm.stage);
  standings[arm.upper.index].between = math::translation({0.1, 0.2, 0.3});
  standings[arm.lower.index].local.rotation = math::axis_angle({0, 1, 0}, 0.7);
  const anim::Clip clip =
      clip_of({test::channel(arm.upper, Path::rotation, kTimes, random_turns(random, 4))});
  TransferOptions options;
  options.standings = standings;
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, options, report);
  CHECK(report.controls == 2);
  for (const double time : {0.0, 0.5, 2.0})
    CHECK(difference_at(arm, standings, clip, applied(clip, change), time) < 1e-6);
  const anim::Channel* still = test::find(change.clip, arm.lower_control, Path::rotation);
  REQUIRE(still);
  CHECK(still->curve.times->size() == 1);
}

TEST_CASE("bake transfer: a clip without channels on driven joints is left alone") {
  const Arm arm;
  const anim::Clip clip =
      clip_of({test::channel(arm.hand, Path::rotation, {0}, {0, 0, 0, 1}),
               test::channel(arm.upper_control, Path::rotation, {0}, {0, 0, 0, 1})});
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, {}, report);
  CHECK(report.joints == 0);
  CHECK(change.clip.channels.empty());
  CHECK(change.dropped.empty());
}

TEST_CASE("bake transfer: what a bake made before is no source") {
  const Arm arm;
  anim::Clip clip = clip_of({test::channel(arm.upper, Path::rotation, {0}, {0, 0, 0, 1})});
  clip.channels[0].baked = true;
  TransferReport report;
  CHECK(transferred(arm.stage, clip, {}, report).clip.channels.empty());
}

TEST_CASE("bake transfer: scales that no control drives stay where they matter") {
  const Arm arm;
  const float little = 1.0f + 1e-6f;
  const anim::Clip clip =
      clip_of({test::channel(arm.upper, Path::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f}),
               test::channel(arm.upper, Path::scale, {0, 1}, {1, 1, 1, 2, 2, 2}),
               test::channel(arm.lower, Path::scale, {0, 1}, {1, 1, 1, little, 1, 1})});
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, {}, report);
  CHECK(report.kept == std::vector<NodeId>{arm.upper});
  CHECK(change.dropped == std::vector<int>{0, 2});
  const anim::Clip on_controls = applied(clip, change);
  for (const double time : {0.0, 0.5, 1.0})
    CHECK(difference_at(arm, test::as_scene(arm.stage), clip, on_controls, time) < 1e-5);
}

TEST_CASE("bake transfer: steps stay steps, and hold to their end beside lines") {
  const Arm arm;
  const std::vector<float> turns{0, 0, 0, 1, 0, 0, 0.6f, 0.8f};
  const auto step = test::channel(arm.upper, Path::rotation, {0, 1}, turns, Interpolation::step);
  TransferReport report;
  const anim::Clip alone = clip_of({step});
  const Transferred stepped = transferred(arm.stage, alone, {}, report);
  REQUIRE(stepped.clip.channels.size() == 1);
  CHECK(stepped.clip.channels[0].curve.interpolation == Interpolation::step);
  CHECK(difference_at(arm, test::as_scene(arm.stage), alone, stepped.clip, 0.99) < 1e-6);

  const anim::Clip mixed = clip_of({step, test::channel(arm.lower, Path::rotation, {0, 1}, turns)});
  const Transferred linear = transferred(arm.stage, mixed, {}, report);
  for (const double time : {0.0, 0.4, 0.99, 1.0})
    CHECK(difference_at(arm, test::as_scene(arm.stage), mixed, linear.clip, time) < 1e-5);
}

TEST_CASE("bake transfer: cubic curves are sampled between their keys") {
  const Arm arm;
  std::vector<float> values;
  for (const float x : {0.0f, 0.2f}) {
    values.insert(values.end(), {0, 0, 2});     // in tangent
    values.insert(values.end(), {x, 1.4f, 0});  // value
    values.insert(values.end(), {0, 0, 2});     // out tangent
  }
  const anim::Clip clip =
      clip_of({test::channel(arm.upper, Path::translation, {0, 1}, values, Interpolation::cubic)});
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, {}, report);
  CHECK(report.frames > 50);
  for (const double time : {0.0, 0.31, 0.5, 0.77, 1.0})
    CHECK(difference_at(arm, test::as_scene(arm.stage), clip, change.clip, time) < 1e-3);
}

TEST_CASE("bake transfer: a tolerance adds keys where they are needed, and only there") {
  const Arm arm;
  std::vector<float> values;
  for (const float x : {0.0f, 0.2f, 0.2f}) {
    const float tangent = x == 0 ? 2.0f : 0.0f;
    values.insert(values.end(), {0, 0, tangent});  // in tangent
    values.insert(values.end(), {x, 1.4f, 0});     // value
    values.insert(values.end(), {0, 0, tangent});  // out tangent
  }
  const anim::Clip clip = clip_of(
      {test::channel(arm.upper, Path::translation, {0, 1, 2}, values, Interpolation::cubic)});
  std::size_t frames = 3;
  for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
    CAPTURE(tolerance);
    TransferOptions options;
    options.tolerance = tolerance;
    TransferReport report;
    const Transferred change = transferred(arm.stage, clip, options, report);
    CHECK(report.frames == 3 + report.inserted);
    CHECK(report.frames > frames);
    CHECK(report.between.distance < tolerance + report.at_keys.distance);
    frames = report.frames;
    for (const double time : {0.0, 0.31, 0.5, 0.77, 1.0, 1.6})
      CHECK(difference_at(arm, test::as_scene(arm.stage), clip, change.clip, time) <
            4 * tolerance + 1e-6);
    REQUIRE(change.clip.channels.size() == 1);
    const auto& times = *change.clip.channels[0].curve.times;
    CHECK(std::is_sorted(times.begin(), times.end()));
    CHECK(times[times.size() - 2] == 1.0f);  // nothing moves after it
  }
}

TEST_CASE("bake transfer: with a rate there are no keys beside its frames") {
  std::mt19937_64 random(13);
  const Arm arm;
  const anim::Clip clip =
      clip_of({test::channel(arm.upper, Path::rotation, kTimes, random_turns(random, 4))});
  TransferOptions options;
  options.fps = 3;
  options.tolerance = 1e-6;
  TransferReport report;
  transferred(arm.stage, clip, options, report);
  CHECK(report.frames == 7);
  CHECK(report.inserted == 0);
  CHECK(report.between.angle > 1e-2);  // where the joint has keys off that grid
}

TEST_CASE("bake transfer: joints that nothing moves keep their channels and are named") {
  const Arm arm;
  const anim::Clip clip =
      clip_of({test::channel(arm.hand, Path::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f}),
               test::channel(arm.upper, Path::translation, {0, 1}, {0, 0, 0, 1, 1, 1})});
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, {}, report);
  CHECK(report.untouched == std::vector<NodeId>{arm.hand});
  CHECK(report.kept.empty());
  CHECK(report.replaced.empty());
  CHECK(change.dropped == std::vector<int>{1});
}

TEST_CASE("bake transfer: controls whose keys are replaced are named") {
  const Arm arm;
  const std::vector<float> turns{0, 0, 0, 1, 0, 0, 0.6f, 0.8f};
  const anim::Clip clip = clip_of({test::channel(arm.lower_control, Path::rotation, {0, 1}, turns),
                                   test::channel(arm.upper, Path::rotation, {0, 1}, turns)});
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, {}, report);
  CHECK(report.replaced == std::vector<NodeId>{arm.lower_control});
  const anim::Clip after = applied(clip, change);
  CHECK_FALSE(test::find(after, arm.lower_control, Path::rotation));  // the lower joint rests
}

TEST_CASE("bake transfer: a range and a rate choose the keys") {
  std::mt19937_64 random(9);
  const Arm arm;
  const anim::Clip clip =
      clip_of({test::channel(arm.upper, Path::rotation, kTimes, random_turns(random, 4))});
  TransferOptions options;
  options.fps = 10;
  options.start = 0.5;
  options.end = 1;
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, options, report);
  CHECK(report.frames == 6);
  REQUIRE(change.clip.channels.size() == 1);
  CHECK(change.clip.channels[0].curve.times->front() == 0.5f);
  options.start = 2;
  Diagnostics diagnostics;
  CHECK_FALSE(transfer(arm.stage.scene, arm.stage.nodes(), clip, options, report, diagnostics));
  CHECK(diagnostics.all()[0].code->number == 600);
}

TEST_CASE("bake transfer: rotations of neighbouring keys are on one side") {
  std::mt19937_64 random(11);
  const Arm arm;
  std::vector<float> times;
  for (int i = 0; i < 40; ++i) times.push_back(static_cast<float>(i) / 10);
  const anim::Clip clip =
      clip_of({test::channel(arm.upper, Path::rotation, times, random_turns(random, 40))});
  TransferReport report;
  const Transferred change = transferred(arm.stage, clip, {}, report);
  const anim::Channel* turns = test::find(change.clip, arm.upper_control, Path::rotation);
  REQUIRE(turns);
  for (std::size_t i = 4; i < turns->curve.values.size(); i += 4) {
    float dot = 0;
    for (std::size_t k = 0; k < 4; ++k)
      dot += turns->curve.values[i + k] * turns->curve.values[i - 4 + k];
    CHECK(dot >= 0);
  }
}

TEST_CASE("bake transfer: a rounded goal keeps the limb's length") {
  Bones bones;
  bones.start = {1.1, 2.3, -0.7};
  bones.first = bones.second = math::normalised(math::Vec3{0.3, -0.8, 0.2});
  bones.middle = bones.start + bones.first * 0.3;
  bones.end = bones.middle + bones.second * 0.25;
  const math::Affine to_point = math::compose(
      {{3.1, -2.2, 0.4}, math::axis_angle(math::normalised(math::Vec3{1, 2, 3}), 0.8), {1, 1, 1}});
  const math::Vec3 t = rounded_goal(bones, to_point);
  for (std::size_t i = 0; i < 3; ++i) CHECK(t[i] == static_cast<double>(static_cast<float>(t[i])));
  CHECK(std::abs(math::length(to_point * t - bones.start) - 0.55) < 3e-8);
}

}  // namespace rigc::bake
