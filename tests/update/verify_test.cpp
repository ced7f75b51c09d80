// SPDX-License-Identifier: MIT
// The comparison of how two rigs play: what it measures, at which times, and that nothing is zero.
#include "update/verify.h"

#include <doctest/doctest.h>

#include <numeric>

#include "scene/edit.h"
#include "support/rig.h"

namespace rigc {
namespace {

using anim::Interpolation;
using anim::Path;
using scene::NodeId;
using scene::Scene;

const char* const kMast = R"(joints:
  - name: base
    local: mast
    label: base
    at: [0, 0, 0]
    tags: [{command: control, with: {drive: on}}]
  - {name: top, parent: base, at: [0, 2, 0], local: mast, label: top}
)";

struct Rig {
  test::Rig built{test::template_of(kMast)};
  Scene scene = built.scene();
  std::vector<int> nodes;
  NodeId control, base, top;

  Rig() : control(built.node("mast/control.control")) {
    REQUIRE(built.clean());
    nodes.resize(scene.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    base = built.node("mast.base::joint");
    top = built.node("mast.top::joint");
  }
  void pose(std::uint16_t attribute, const scene::Value& value) {
    scene::Journal journal;
    scene::Edit(scene, journal, nullptr).set({control, attribute}, value);
  }
  anim::Channel channel(Path path, std::vector<float> times, std::vector<float> values,
                        Interpolation interpolation = Interpolation::linear) const {
    anim::Channel out;
    out.node = static_cast<int>(control.index);
    out.path = path;
    out.curve.interpolation = interpolation;
    out.curve.width = path == Path::rotation ? 4 : 3;
    out.curve.times = std::make_shared<const std::vector<float>>(std::move(times));
    out.curve.values = std::move(values);
    return out;
  }
};

/// `count` keys that move up, at times that are not even.
anim::Clip rising(const Rig& rig, std::size_t count, float extra = 0) {
  std::vector<float> times, values;
  for (std::size_t i = 0; i < count; ++i) {
    times.push_back(static_cast<float>(i) * 0.1f + static_cast<float>(i % 3) * 0.01f);
    values.insert(values.end(), {0, static_cast<float>(i) * 0.01f + extra, 0});
  }
  anim::Clip clip;
  clip.channels.push_back(rig.channel(Path::translation, times, values));
  return clip;
}

update::Comparison compare(const Rig& a, const anim::Clip& p, const Rig& b, const anim::Clip& q,
                           double unit = 1) {
  Diagnostics diagnostics;
  const auto out =
      update::compare({&a.scene, &a.nodes}, {&b.scene, &b.nodes}, {{&p, &q}},
                      {{"base", a.base, b.base}, {"top", a.top, b.top}}, unit, diagnostics);
  REQUIRE_MESSAGE(out, render(diagnostics, false));
  REQUIRE(out->size() == 1);
  REQUIRE(out->front().joints.size() == 2);
  return out->front();
}

bool is_zero(const update::Comparison& comparison) {
  for (const update::Difference& joint : comparison.joints)
    if (joint.largest_mm != 0 || joint.mean_mm != 0 || joint.largest_degrees != 0 ||
        joint.mean_degrees != 0)
      return false;
  return true;
}

}  // namespace

TEST_CASE("verify: the same rig with the same clip is exactly the same") {
  const Rig a, b;
  const anim::Clip clip = rising(a, 10);
  const auto comparison = compare(a, clip, b, clip);
  CHECK(is_zero(comparison));
  CHECK(comparison.times == 19);  // 10 keys and 9 midway
  CHECK(comparison.all_times == 19);
  CHECK(comparison.joints[0].joint == "base");
  CHECK(comparison.joints[1].joint == "top");
}

TEST_CASE("verify: a clip without keys is compared once") {
  const Rig a;
  Rig b;
  CHECK(compare(a, {}, b, {}).times == 1);
  CHECK(is_zero(compare(a, {}, b, {})));
  b.pose(scene::transform::kTranslate, math::Vec3{0.25, 0, 0});
  CHECK(compare(a, {}, b, {}).joints[0].largest_mm == doctest::Approx(250));
}

TEST_CASE("verify: times are thinned evenly, and both ends are among them") {
  const Rig a;
  for (const std::size_t keys : {1000u, 1001u, 5000u}) {
    CAPTURE(keys);
    const anim::Clip clip = rising(a, keys);
    const auto comparison = compare(a, clip, a, clip);
    CHECK(comparison.all_times == 2 * keys - 1);
    CHECK(comparison.times == std::min<std::size_t>(2 * keys - 1, update::kMostTimes));
  }
  // A difference at the last key alone, and one at the first.
  for (const bool last : {true, false}) {
    const anim::Clip clip = rising(a, 5000);
    anim::Clip other = clip;
    other.channels[0].curve.values[last ? 3 * 4999 : 0] += 1;
    const auto comparison = compare(a, clip, a, other);
    CHECK(comparison.joints[0].largest_mm == doctest::Approx(1000));
    CHECK(comparison.joints[0].mean_mm < 2);
    CHECK(comparison.joints[0].mean_mm > 0);
  }
}

TEST_CASE("verify: distances in millimetres of the template, and their mean") {
  const Rig a;
  const anim::Clip clip = rising(a, 5);
  const auto all = compare(a, clip, a, rising(a, 5, 0.5f));
  CHECK(all.joints[1].largest_mm == doctest::Approx(500));
  CHECK(all.joints[1].mean_mm == doctest::Approx(500));
  CHECK(all.joints[1].largest_degrees == 0);
  CHECK(compare(a, clip, a, rising(a, 5, 0.5f), 100).joints[1].largest_mm == doctest::Approx(5));
}

TEST_CASE("verify: angles, and what they move further out") {
  const Rig a;
  anim::Clip still, turned;
  still.channels.push_back(a.channel(Path::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1}));
  turned.channels.push_back(
      a.channel(Path::rotation, {0, 1}, {0, 0, 0, 1, 0, 0, 0.258819045f, 0.965925826f}));
  const auto comparison = compare(a, still, a, turned);
  CHECK(comparison.joints[0].largest_degrees == doctest::Approx(30).epsilon(1e-5));
  CHECK(comparison.joints[0].mean_degrees == doctest::Approx(15).epsilon(1e-5));
  CHECK(comparison.joints[0].largest_mm < 1e-6);
  CHECK(comparison.joints[1].largest_mm ==
        doctest::Approx(2000 * 2 * 0.258819045).epsilon(1e-5));  // chord over two metres
}

TEST_CASE("verify: what differs between keys only is seen midway") {
  const Rig a;
  anim::Clip linear, step;
  linear.channels.push_back(a.channel(Path::translation, {0, 1}, {0, 0, 0, 1, 0, 0}));
  step.channels.push_back(
      a.channel(Path::translation, {0, 1}, {0, 0, 0, 1, 0, 0}, Interpolation::step));
  const auto comparison = compare(a, linear, a, step);
  CHECK(comparison.times == 3);
  CHECK(comparison.joints[0].largest_mm == doctest::Approx(500));
}

TEST_CASE("verify: keys of either clip count") {
  const Rig a;
  anim::Clip sparse, dense;
  sparse.channels.push_back(a.channel(Path::translation, {0, 1}, {0, 0, 0, 1, 0, 0}));
  dense.channels.push_back(
      a.channel(Path::translation, {0, 0.3f, 1}, {0, 0, 0, 0.9f, 0, 0, 1, 0, 0}));
  for (const bool swapped : {false, true}) {
    const auto comparison = swapped ? compare(a, dense, a, sparse) : compare(a, sparse, a, dense);
    CHECK(comparison.times == 5);
    CHECK(comparison.joints[0].largest_mm == doctest::Approx(600).epsilon(1e-5));
  }
}

TEST_CASE("verify: a rig that cannot be evaluated is reported") {
  Rig a, b;
  scene::Journal journal;
  scene::Edit edit(b.scene, journal, nullptr);
  // The control follows the joint that follows it.
  edit.connect({b.base, scene::transform::kTranslate}, {b.control, scene::transform::kTranslate});
  Diagnostics diagnostics;
  const anim::Clip none;
  CHECK(!update::compare({&a.scene, &a.nodes}, {&b.scene, &b.nodes}, {{&none, &none}},
                         {{"base", a.base, b.base}}, 1, diagnostics));
  CHECK(!diagnostics.ok());
}

}  // namespace rigc
