// SPDX-License-Identifier: MIT
// Bakes against direct evaluation: what a player of the baked clip shows is what the rig does.
#include "bake/bake.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/codes.h"
#include "bake_helpers.h"
#include "tests/math/random.h"

using namespace rigc;
using namespace rigc::bake;
using namespace rigc::bake::test;
using anim::Path;
using scene::NodeId;
namespace transform = rigc::scene::transform;

namespace {

/// A chain of three bones below a root that nothing drives; the first two have controls.
struct Arm {
  Stage stage;
  NodeId root, upper, lower, hand, upper_control, lower_control;

  Arm() {
    root = stage.joint("root", {}, {{0.1, 0, 0}, math::axis_angle({0, 1, 0}, 0.4), {1, 1, 1}});
    upper = stage.joint("upper", root, {{0, 1, 0}, math::axis_angle({0, 0, 1}, 0.3), {1, 1, 1}});
    lower =
        stage.joint("lower", upper, {{0.5, 0, 0}, math::axis_angle({1, 0, 0}, -0.2), {1, 1, 1}});
    hand = stage.joint("hand", lower, {{0.4, 0, 0}, {}, {1, 1, 1}});
    upper_control = stage.control_for(upper);
    lower_control = stage.control_for(lower, upper_control);
  }
};

std::vector<float> rotation(math::Vec3 axis, double radians) {
  const math::Quat q = math::axis_angle(math::normalised(axis), radians);
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
          static_cast<float>(q.w)};
}

std::vector<float> joined(std::initializer_list<std::vector<float>> lists) {
  std::vector<float> out;
  for (const auto& list : lists) out.insert(out.end(), list.begin(), list.end());
  return out;
}

anim::Clip wave(const Arm& arm) {
  anim::Clip clip;
  clip.name = "wave";
  clip.source_animation = 4;
  clip.channels.push_back(channel(arm.upper_control, Path::translation, {0, 0.5f, 1},
                                  {0, 0, 0, 0.1f, 0.2f, 0, 0, 0.3f, 0.1f}));
  clip.channels.push_back(channel(arm.lower_control, Path::rotation, {0.25f, 0.75f},
                                  joined({rotation({0, 0, 1}, -1), rotation({0, 1, 1}, 1.5)})));
  return clip;
}

/// Largest difference of any joint between the played bake and the rig, at the frames of the bake.
double bake_error(const Arm& arm, const anim::Clip& clip, const anim::Clip& out,
                  const std::vector<Standing>& standings) {
  double largest = 0;
  for (int frame = 0; frame <= 30; ++frame) {
    const double seconds = static_cast<double>(static_cast<float>(frame / 30.0));
    const auto truth = evaluated(arm.stage, clip, seconds);
    const auto shown = played(arm.stage, standings, out, seconds);
    for (const NodeId id : {arm.root, arm.upper, arm.lower, arm.hand})
      largest = std::max(largest, difference(truth[id.index], shown[id.index]));
  }
  return largest;
}

std::vector<int> numbers(const Diagnostics& diagnostics) {
  std::vector<int> list;
  for (const Diagnostic& diagnostic : diagnostics.all()) list.push_back(diagnostic.code->number);
  return list;
}

}  // namespace

TEST_CASE("bake: the joints of the baked clip do what the rig does") {
  const Arm arm;
  const anim::Clip clip = wave(arm);
  Report report;
  const anim::Clip out = baked(arm.stage, clip, {}, report);
  CHECK(out.name == "wave");
  CHECK(out.source_animation == 4);
  CHECK(bake_error(arm, clip, out, as_scene(arm.stage)) < 2e-6);
  CHECK(report.frames == 31);
  CHECK(report.channels == out.channels.size());
  CHECK(report.shear.relative == 0);
  CHECK(report.shear.distance == 0);
  CHECK(report.reduction_error == 0);
  CHECK(report.driven ==
        std::vector<int>{static_cast<int>(arm.upper.index), static_cast<int>(arm.lower.index)});
}

TEST_CASE("bake: only what moves has channels, and they share their times") {
  const Arm arm;
  Report report;
  const anim::Clip out = baked(arm.stage, wave(arm), {}, report);
  CHECK(find(out, arm.upper, Path::translation) != nullptr);
  CHECK(find(out, arm.upper, Path::rotation) == nullptr);
  CHECK(find(out, arm.upper, Path::scale) == nullptr);
  CHECK(find(out, arm.lower, Path::rotation) != nullptr);
  CHECK(find(out, arm.lower, Path::translation) == nullptr);
  for (const NodeId id : {arm.root, arm.hand, arm.upper_control, arm.lower_control})
    for (const Path path : {Path::translation, Path::rotation, Path::scale})
      CHECK(find(out, id, path) == nullptr);
  REQUIRE(out.channels.size() == 2);
  CHECK(out.channels[0].curve.times == out.channels[1].curve.times);
  CHECK(out.channels[0].curve.interpolation == anim::Interpolation::linear);
  CHECK(out.channels[0].source_channel == -1);
}

TEST_CASE("bake: a channel that never changes has one key") {
  Arm arm;
  arm.stage.edit.set({arm.upper_control, transform::kTranslate}, math::Vec3{0, 0.25, 0});
  Report report;
  const anim::Clip out = baked(arm.stage, wave(arm), {}, report);
  anim::Clip only_lower = wave(arm);
  only_lower.channels.erase(only_lower.channels.begin());
  const anim::Clip still = baked(arm.stage, only_lower, {}, report);
  const anim::Channel* moved = find(still, arm.upper, Path::translation);
  REQUIRE(moved);
  CHECK(moved->curve.times->size() == 1);
  CHECK(moved->curve.values.size() == 3);
  CHECK(bake_error(arm, only_lower, still, as_scene(arm.stage)) < 2e-6);
}

TEST_CASE("bake: attributes, steps and cubic curves count") {
  Arm arm;
  const scene::Plug height =
      arm.stage.edit.add_attribute(arm.upper_control, {"height", {}, 0, 0, {}, {}, true});
  arm.stage.edit.connect(height, {arm.lower_control, transform::kTranslate, -1, 1});
  anim::Clip clip;
  clip.channels.push_back(channel(arm.upper_control, Path::attribute, {0, 0.4f, 1}, {0, 1, 0.5f},
                                  anim::Interpolation::step));
  clip.channels.back().attribute = "height";
  clip.channels.push_back(channel(arm.upper_control, Path::translation, {0, 1},
                                  {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0.5f, 0, 0, 0, 0},
                                  anim::Interpolation::cubic));
  Report report;
  const anim::Clip out = baked(arm.stage, clip, {}, report);
  CHECK(bake_error(arm, clip, out, as_scene(arm.stage)) < 2e-6);
  CHECK(find(out, arm.lower, Path::translation) != nullptr);
  CHECK(find(out, arm.upper, Path::translation) != nullptr);
}

TEST_CASE("bake: quaternions do not jump") {
  const Arm arm;
  anim::Clip clip;
  // Three full turns, with keys of either sign.
  std::vector<float> times, values;
  for (int i = 0; i <= 24; ++i) {
    times.push_back(static_cast<float>(i) / 24);
    auto q = rotation({1, 2, 0.5}, i * math::kPi / 4);
    if (i % 3 == 1)
      for (float& n : q) n = -n;
    values.insert(values.end(), q.begin(), q.end());
  }
  clip.channels.push_back(channel(arm.lower_control, Path::rotation, times, values));
  Report report;
  Options options;
  options.fps = 120;
  const anim::Clip out = baked(arm.stage, clip, options, report);
  const anim::Channel* turned = find(out, arm.lower, Path::rotation);
  REQUIRE(turned);
  const auto& v = turned->curve.values;
  for (std::size_t i = 4; i < v.size(); i += 4)
    CHECK(v[i] * v[i - 4] + v[i + 1] * v[i - 3] + v[i + 2] * v[i - 2] + v[i + 3] * v[i - 1] > 0.9f);
}

TEST_CASE("bake: nothing on controls gives nothing") {
  const Arm arm;
  anim::Clip clip;
  clip.channels.push_back(channel(arm.hand, Path::translation, {0, 1}, {0, 0, 0, 1, 0, 0}));
  Report report;
  CHECK(baked(arm.stage, clip, {}, report).channels.empty());
}

TEST_CASE("bake: channels on what the rig drives do not count, those on free joints do") {
  const Arm arm;
  anim::Clip clip = wave(arm);
  const anim::Clip plain = clip;
  clip.channels.push_back(channel(arm.upper, Path::rotation, {0, 1}, {1, 0, 0, 0, 0, 1, 0, 0}));
  Report report, plain_report;
  const anim::Clip out = baked(arm.stage, clip, {}, report);
  const anim::Clip expected = baked(arm.stage, plain, {}, plain_report);
  REQUIRE(out.channels.size() == expected.channels.size());
  for (std::size_t i = 0; i < out.channels.size(); ++i)
    CHECK(out.channels[i].curve.values == expected.channels[i].curve.values);
  // The root is free: its own channel stays in the file, and the driven joints below make up for
  // it.
  clip = plain;
  clip.channels.push_back(channel(arm.root, Path::translation, {0, 1}, {0.1f, 0, 0, 2, 0, 0}));
  anim::Clip shown = baked(arm.stage, clip, {}, report);
  CHECK(find(shown, arm.root, Path::translation) == nullptr);
  shown.channels.push_back(clip.channels.back());
  CHECK(bake_error(arm, clip, shown, as_scene(arm.stage)) < 2e-6);
}

TEST_CASE("bake: joints that stand otherwise in their file are where the rig has them") {
  rigc::test::Random random(5);
  for (int round = 0; round < 10; ++round) {
    const Arm arm;
    const anim::Clip clip = wave(arm);
    Options options;
    options.standings = as_scene(arm.stage);
    auto standing = [&](NodeId id) -> Standing& { return options.standings[id.index]; };
    // The model has no root joint: the upper bone lies under the rig's space, and something is
    // between.
    standing(arm.upper) = {
        {}, math::translation(random.vector()), {random.vector(), random.rotation(), {1, 1, 1}}};
    standing(arm.lower).local = {random.vector(), random.rotation(), {1, 1, 1}};
    standing(arm.lower).between = math::compose({random.vector(), random.rotation(), {2, 2, 2}});
    Report report;
    const anim::Clip out = baked(arm.stage, clip, options, report);
    CHECK(report.shear.relative < 1e-9);
    CHECK(report.shear.distance < 1e-9);
    double largest = 0;
    for (int frame = 0; frame <= 30; ++frame) {
      const auto truth = evaluated(arm.stage, clip, frame / 30.0);
      const auto shown = played(arm.stage, options.standings, out, frame / 30.0);
      for (const NodeId id : {arm.upper, arm.lower, arm.hand})
        largest = std::max(largest, difference(truth[id.index], shown[id.index]));
    }
    CHECK(largest < 1e-5);
  }
}

TEST_CASE("bake: a driven joint under a free one that stands elsewhere makes up for it") {
  const Arm arm;
  const anim::Clip clip = wave(arm);
  Options options;
  options.standings = as_scene(arm.stage);
  options.standings[arm.root.index].local.translation = {3, 0, 0};
  Report report;
  const anim::Clip out = baked(arm.stage, clip, options, report);
  const auto truth = evaluated(arm.stage, clip, 0.5);
  const auto shown = played(arm.stage, options.standings, out, 0.5);
  CHECK(shown[arm.root.index].origin == math::Vec3{3, 0, 0});
  CHECK(difference(truth[arm.hand.index], shown[arm.hand.index]) < 2e-6);
}

TEST_CASE("bake: a joint under a control follows when the control's channels are gone, or stay") {
  Arm arm;
  const NodeId tool = arm.stage.joint("tool", {}, {{0, 0.2, 0}, {}, {1, 1, 1}});
  arm.stage.edit.reparent(tool, arm.lower_control);
  const anim::Clip clip = wave(arm);
  for (const bool controls_play : {false, true}) {
    Options options;
    options.controls_play = controls_play;
    Report report;
    anim::Clip out = baked(arm.stage, clip, options, report);
    CHECK((find(out, tool, Path::rotation) != nullptr) == !controls_play);
    if (controls_play)
      out.channels.insert(out.channels.end(), clip.channels.begin(), clip.channels.end());
    for (const double seconds : {0.0, 0.5, 1.0}) {
      const auto truth = evaluated(arm.stage, clip, seconds);
      const auto shown = played(arm.stage, as_scene(arm.stage), out, seconds);
      CHECK(difference(truth[tool.index], shown[tool.index]) < 2e-6);
    }
  }
}

TEST_CASE("bake: what cannot be expressed is reported as shear") {
  Arm arm;
  const anim::Clip clip = wave(arm);
  Options options;
  options.standings = as_scene(arm.stage);
  options.standings[arm.lower.index].between = math::compose({{}, {}, {1, 3, 1}});
  Report report;
  const anim::Clip out = baked(arm.stage, clip, options, report);
  CHECK(report.shear.relative > 0.01);
  REQUIRE(report.shear.joint == arm.lower);
  // Points at the length of the limb, 0.5 from the joint before it, are as far off as it says.
  double largest = 0, when = 0;
  for (int frame = 0; frame <= 30; ++frame) {
    const double seconds = static_cast<double>(static_cast<float>(frame / 30.0));
    const auto truth = evaluated(arm.stage, clip, seconds);
    const auto shown = played(arm.stage, options.standings, out, seconds);
    const math::Affine& a = shown[arm.lower.index];
    const math::Affine& b = truth[arm.lower.index];
    for (const auto axis : {&math::Mat3::x, &math::Mat3::y, &math::Mat3::z}) {
      const double off = 0.5 * math::length(a.linear.*axis - b.linear.*axis);
      if (off > largest + 1e-6) when = seconds;
      largest = std::max(largest, off);
    }
  }
  CHECK(report.shear.distance == doctest::Approx(largest).epsilon(1e-4));
  CHECK(report.shear.seconds == when);
}

TEST_CASE("bake: on a grid a step is at the very frame of its key") {
  const Arm arm;
  anim::Clip clip;
  std::vector<float> times, values;
  for (int i = 0; i <= 30; ++i) {  // 7 / 30 and others are no floats
    times.push_back(static_cast<float>(i / 30.0));
    values.insert(values.end(), {static_cast<float>(i), 0, 0});
  }
  clip.channels.push_back(
      channel(arm.upper_control, Path::translation, times, values, anim::Interpolation::step));
  Report report;
  const anim::Clip out = baked(arm.stage, clip, {}, report);
  const anim::Channel* moved = find(out, arm.upper, Path::translation);
  REQUIRE(moved);
  REQUIRE(*moved->curve.times == times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto shown = played(arm.stage, as_scene(arm.stage), out, static_cast<double>(times[i]));
    const auto truth = evaluated(arm.stage, clip, static_cast<double>(times[i]));
    CHECK(difference(shown[arm.upper.index], truth[arm.upper.index]) < 1e-5);
  }
}

TEST_CASE("bake: the turning of a joint alone is reduced and measured too") {
  Stage stage;
  const NodeId joint = stage.joint("door", {}, {});
  const NodeId control = stage.control_for(joint);
  anim::Clip clip;
  clip.channels.push_back(
      channel(control, Path::rotation, {0, 0.5f, 1},
              joined({rotation({0, 1, 0}, 0), rotation({0, 1, 0}, 1), rotation({0, 1, 0}, 0)})));
  Options options;
  options.tolerance = 0.01;
  Report report;
  const anim::Clip out = baked(stage, clip, options, report);
  REQUIRE(find(out, joint, Path::rotation));
  CHECK(find(out, joint, Path::rotation)->curve.times->size() == 3);
  for (const double seconds : {0.2, 0.5, 0.8}) {
    const auto truth = evaluated(stage, clip, seconds);
    const auto shown = played(stage, as_scene(stage), out, seconds);
    CHECK(difference(truth[joint.index], shown[joint.index]) <= 0.01);
  }
}

TEST_CASE("bake: every number of threads gives the same clip, and reports the same") {
  const Arm arm;
  const anim::Clip clip = wave(arm);
  Options options;
  options.fps = 700;  // many ranges
  options.standings = as_scene(arm.stage);
  options.standings[arm.lower.index].between = math::compose({{}, {}, {1, 1.2, 1}});
  for (const double tolerance : {0.0, 1e-3}) {
    options.tolerance = tolerance;
    std::vector<anim::Clip> clips;
    std::vector<Report> reports;
    for (const unsigned jobs : {1u, 2u, 3u, 8u}) {
      Threads threads(jobs);
      options.threads = &threads;
      clips.push_back(baked(arm.stage, clip, options, reports.emplace_back()));
    }
    for (std::size_t i = 1; i < clips.size(); ++i) {
      CHECK(reports[i].shear.distance == reports[0].shear.distance);
      CHECK(reports[i].shear.seconds == reports[0].shear.seconds);
      CHECK(reports[i].reduction_error == reports[0].reduction_error);
      REQUIRE(clips[i].channels.size() == clips[0].channels.size());
      for (std::size_t c = 0; c < clips[i].channels.size(); ++c) {
        CHECK(clips[i].channels[c].curve.values == clips[0].channels[c].curve.values);
        CHECK(*clips[i].channels[c].curve.times == *clips[0].channels[c].curve.times);
      }
    }
  }
}

TEST_CASE("bake: the same clip gives the same bytes") {
  const Arm first, second;
  Report report;
  const anim::Clip a = baked(first.stage, wave(first), {}, report);
  const anim::Clip b = baked(second.stage, wave(second), {}, report);
  REQUIRE(a.channels.size() == b.channels.size());
  for (std::size_t i = 0; i < a.channels.size(); ++i) {
    CHECK(a.channels[i].curve.values == b.channels[i].curve.values);
    CHECK(*a.channels[i].curve.times == *b.channels[i].curve.times);
  }
}

TEST_CASE("bake: motion that glTF cannot hold is reported") {
  const Arm arm;
  anim::Clip clip;
  const float big = std::numeric_limits<float>::max();
  clip.channels.push_back(
      channel(arm.upper_control, Path::translation, {0, 1}, {0, 0, 0, big, 0, 0}));
  Report report;
  Diagnostics diagnostics;
  CHECK_FALSE(bake::bake(arm.stage.scene, arm.stage.nodes(), clip, {}, report, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{codes::kNotFinite.number});
}

TEST_CASE("bake: limits of controls and of joints with channels of their own hold") {
  Arm arm;
  const auto limit = [&](NodeId node, std::vector<double> bounds) {
    const NodeId limits = arm.stage.made(scene::Kind::limits, "limits");
    arm.stage.edit.connect({node, transform::kWorld}, {limits, scene::limits::kNode});
    arm.stage.edit.set({limits, scene::limits::kBounds}, std::move(bounds));
    arm.stage.edit.set({limits, scene::limits::kOrder}, std::string("xyz"));
  };
  limit(arm.upper_control, {1, 1, 0.25});  // no higher than that
  limit(arm.hand, {0, 0, 0, 0, 1, 0.6});   // which no control drives
  anim::Clip clip;
  clip.channels.push_back(
      channel(arm.upper_control, Path::translation, {0, 1}, {0, 0, 0, 0, 1, 0}));
  clip.channels.push_back(channel(arm.hand, Path::translation, {0, 1}, {0.4f, 0, 0, 0.8f, 0, 0}));
  Report report;
  const anim::Clip out = baked(arm.stage, clip, {}, report);
  CHECK(std::find(report.driven.begin(), report.driven.end(), static_cast<int>(arm.hand.index)) !=
        report.driven.end());
  for (const double time : {0.0, 0.2, 0.5, 1.0}) {
    const auto wanted = evaluated(arm.stage, clip, time);
    const auto shown = played(arm.stage, as_scene(arm.stage), out, time);
    for (const NodeId joint : {arm.upper, arm.lower, arm.hand})
      CHECK(difference(shown[joint.index], wanted[joint.index]) < 1e-5);
  }
  const auto end = played(arm.stage, as_scene(arm.stage), out, 1);
  const math::Vec3 reach = end[arm.hand.index].origin - end[arm.lower.index].origin;
  CHECK(std::abs(math::length(reach) - 0.6) < 1e-6);
}

TEST_CASE("bake: keys on an attribute that animators may not key have no effect") {
  Arm arm;
  const scene::Plug size =
      arm.stage.edit.add_attribute(arm.upper_control, {"size", {}, 1, 1, {}, {}});
  for (std::int8_t axis = 0; axis < 3; ++axis)
    arm.stage.edit.connect(size, {arm.upper_control, transform::kScale, -1, axis});
  anim::Clip clip;
  clip.channels.push_back(channel(arm.upper_control, Path::attribute, {0, 1}, {1, 3}));
  clip.channels.back().attribute = "size";
  Report report;
  CHECK_FALSE(baked(arm.stage, clip, {}, report).channels.empty());
  arm.stage.edit.set_access(size, false, false);
  CHECK(baked(arm.stage, clip, {}, report).channels.empty());
}
