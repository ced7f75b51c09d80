// SPDX-License-Identifier: MIT
// ribbon on a surface: joints lie on a sash or belt of the model, which bends, twists and squashes
// with the controls along it.
#include <doctest/doctest.h>

#include <cmath>

#include "support/models.h"
#include "support/surfaces.h"

using namespace rigc;
using math::Affine;
using math::Vec3;

namespace {

std::string waist(const std::string& with = "count: 7", const std::string& riders = {}) {
  return test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: root, with: {}}
      - {command: control, with: {}}
  - name: hips
    parent: base
    at: [0, 1, 0]
    local: hips
    label: hips
    tags:
      - {command: control, with: {}}
      - {command: ribbon, with: {surface: sash, )" +
                           with + R"(}}
  - {name: chest, parent: hips, at: [0, 1.5, 0], local: chest, label: chest}
)" + riders);
}

/// Around the front at radius 0.5, from the right to the left, 0.2 high; seen from outside.
Vec3 half_belt(double u, double v) {
  const double angle = math::kPi * u;
  return Vec3{-0.5 * math::cos(angle), 1 + 0.2 * v, 0.5 * math::sin(angle)};
}
Vec3 whole_belt(double u, double v) { return half_belt(2 * u, v); }
/// A metre to the front, face up.
Vec3 tongue(double u, double v) { return {0.2 * (v - 0.5), 1, u}; }

std::vector<Affine> pins(const test::Rig& rig, const test::Pose& pose) {
  return pose.worlds(rig.nodes("hips/ribbon.joint"));
}
std::string tweak(int i) { return "hips/ribbon.tweak[" + std::to_string(i) + "]"; }

/// What pins do: world * rest world^-1.
std::vector<Affine> pin_motion(const test::Rig& rig, const test::Pose& pose) {
  std::vector<Affine> out = pins(rig, pose);
  const auto rest = pins(rig, test::Pose(rig));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = out[k] * math::inverse(rest[k]);
  return out;
}

}  // namespace

TEST_CASE("modules ribbon on a surface: pins at even places with its normal, and at rest") {
  const test::Sash sash(test::sheet(half_belt), 1);
  const test::Rig rig(waist(), sash.change(), true, sash.geometry());
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  CHECK(rig.nodes("hips/ribbon.tweak").size() == 3);
  const auto at = pins(rig, test::Pose(rig));
  REQUIRE(at.size() == 7);
  for (std::size_t k = 0; k < 7; ++k) {
    CAPTURE(k);
    const Vec3 place = half_belt(static_cast<double>(k) / 6, 0.5);
    CHECK(test::distance(at[k].origin, place) < 1e-12);
    const Vec3 out = math::normalised(Vec3{place.x, 0, place.z});
    // Triangles at the ends have a neighbour on one side alone.
    CHECK(math::dot(at[k].linear.y, out) > (k % 6 ? 1 - 1e-9 : 0.997));
    CHECK(std::abs(at[k].linear.z.y) == doctest::Approx(1));
  }
  for (int i = 0; i < 3; ++i)
    CHECK(test::distance(test::Pose(rig).position(tweak(i)), half_belt(0.5 * i, 0.5)) < 1e-12);
}

TEST_CASE("modules ribbon on a surface: it goes with its joint, or with what it hangs under") {
  const test::Sash sash(test::sheet(half_belt), 1);
  const test::Rig rig(waist(), sash.change(), true, sash.geometry());
  const test::Rig hung(waist("count: 7, parent: base/control"), sash.change(), true,
                       sash.geometry());
  REQUIRE(rig.clean());
  REQUIRE(hung.clean());
  CHECK(test::rest_error(hung) < 1e-9);
  const auto turned = [](const test::Rig& on) {
    return pin_motion(on, test::Pose(on).rotate("hips/control", {0, 40, 20}))[3];
  };
  const Affine expected = test::Pose(rig).rotate("hips/control", {0, 40, 20}).world("hips.hips") *
                          math::inverse(rig.rest("hips.hips"));
  CHECK(test::difference(turned(rig), expected, 1) < 1e-9);
  CHECK(test::difference(turned(hung), {}, 1) < 1e-9);
  test::Pose large(rig);
  large.set("base/root.world@master_scale", 2.0);
  const auto rest = pins(rig, test::Pose(rig)), scaled = pins(rig, large);
  for (std::size_t k = 0; k < rest.size(); ++k) {
    CHECK(test::distance(scaled[k].origin, rest[k].origin * 2) < 1e-9);
    CHECK(math::length(scaled[k].linear.y) == doctest::Approx(2));
  }
}

TEST_CASE("modules ribbon on a surface: the middle bends it, the ends stay") {
  const test::Sash sash(test::sheet(tongue), 1);
  const test::Rig rig(waist("count: 11"), sash.change(), true, sash.geometry());
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.move_to(tweak(1), {0.1, 1.3, 0.5});
  const auto at = pins(rig, pose);
  CHECK(test::distance(at[5].origin, {0.1, 1.3, 0.5}) < 1e-9);
  CHECK(test::distance(at[0].origin, {0, 1, 0}) < 1e-9);
  CHECK(test::distance(at[10].origin, {0, 1, 1}) < 1e-9);
  for (std::size_t k = 0; k < 10; ++k) {
    const double step = test::distance(at[k].origin, at[k + 1].origin);
    CHECK(step > 0.08);
    CHECK(step < 0.2);
    CHECK(math::dot(math::normalised(at[k].linear.y), math::normalised(at[k + 1].linear.y)) > 0.9);
  }
  // The end takes its half along.
  test::Pose end(rig);
  end.move_to(tweak(2), {0, 1.4, 0.9});
  CHECK(test::distance(pins(rig, end)[10].origin, {0, 1.4, 0.9}) < 1e-9);
  CHECK(test::distance(pins(rig, end)[0].origin, {0, 1, 0}) < 1e-9);
}

TEST_CASE("modules ribbon on a surface: twist, squash, volume and stretch as over a limb") {
  const test::Sash sash(test::sheet(tongue), 1);
  const test::Rig rig(waist("count: 5, volume: 1"), sash.change(), true, sash.geometry());
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  const auto rest = pins(rig, pose);
  pose.set(tweak(1) + "@twist_end", 90.0);
  const auto turned = pins(rig, pose);
  for (std::size_t k = 0; k < 5; ++k) {
    const math::Quat turn =
        math::axis_angle(rest[k].linear.x, math::radians(22.5 * static_cast<double>(k)));
    CHECK(test::distance(turned[k].linear.y, math::rotate(turn, rest[k].linear.y)) < 1e-9);
  }
  pose.set(tweak(1) + "@squash", 0.5);
  CHECK(math::length(pins(rig, pose)[2].linear.z) == doctest::Approx(1.5));
  pose.move_to(tweak(2), {0, 1, 2});
  CHECK(math::length(pins(rig, pose)[2].linear.z) < 1.5);
  pose.set(tweak(1) + "@stretch", 0.0);
  CHECK(test::distance(pins(rig, pose)[4].origin, pins(rig, pose)[0].origin) == doctest::Approx(1));
}

TEST_CASE("modules ribbon on a surface: a belt goes round without a seam") {
  const test::Sash sash(test::sheet(whole_belt, 48), 1);
  const test::Rig rig(waist("count: 8, controls: 4"), sash.change(), true, sash.geometry());
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  const auto rest = pins(rig, test::Pose(rig));
  REQUIRE(rest.size() == 8);
  for (std::size_t k = 0; k < 8; ++k)
    CHECK(test::distance(rest[k].origin, whole_belt(static_cast<double>(k) / 8, 0.5)) < 1e-12);
  // The first control stands at the seam, on the right: front and back move alike.
  test::Pose pose(rig);
  pose.move_to(tweak(0), {-0.7, 1.1, 0});
  const auto moved = pins(rig, pose);
  CHECK(test::distance(moved[0].origin, {-0.7, 1.1, 0}) < 1e-9);
  for (std::size_t k = 1; k < 4; ++k) {
    const Vec3 front = moved[k].origin, back = moved[8 - k].origin;
    CHECK(test::distance(front, {back.x, back.y, -back.z}) < 1e-9);
  }
  CHECK(moved[1].origin.x < rest[1].origin.x - 0.05);
  CHECK(test::distance(moved[4].origin, rest[4].origin) < 1e-9);
  // Twist grows towards the far side, and is the same from both.
  test::Pose twisted(rig);
  twisted.set(tweak(2) + "@twist_end", 60.0);
  const auto turned = pins(rig, twisted);
  CHECK(test::distance(turned[0].linear.y, rest[0].linear.y) < 1e-9);
  CHECK(math::dot(turned[4].linear.y, rest[4].linear.y) == doctest::Approx(0.5));
  CHECK(math::dot(turned[2].linear.y, rest[2].linear.y) ==
        doctest::Approx(math::dot(turned[6].linear.y, rest[6].linear.y)));
}

TEST_CASE("modules ribbon on a surface: on a belt the start and the end are one place") {
  const test::Sash sash(test::sheet(whole_belt, 48), 1);
  const test::Rig rig(waist("places: [0, 0.5, 1]"), sash.change(), true, sash.geometry());
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.move_to(tweak(0), {-0.7, 1.1, 0});
  const auto at = pins(rig, pose);
  CHECK(test::distance(at[0].origin, {-0.7, 1.1, 0}) < 1e-9);
  CHECK(test::distance(at[2].origin, at[0].origin) < 1e-9);
  // Joints of the model that lie on it.
  const std::string riders =
      "  - {name: left, parent: hips, at: [0.5, 1.1, 0], local: tip, label: a}\n"
      "  - {name: back, parent: hips, at: [0, 1.1, -0.5], local: tip, label: b}\n";
  const test::Rig given(waist("joints: [tip.a, tip.b], controls: 4", riders), sash.change(), true,
                        sash.geometry());
  INFO(test::text(given.diagnostics));
  REQUIRE(given.clean());
  CHECK(test::rest_error(given) < 1e-9);
  test::Pose moved(given);
  moved.move_to(tweak(3), {0, 1.2, -0.6});
  CHECK(test::distance(moved.position("tip.b"), {0, 1.2, -0.6}) < 1e-6);
  CHECK(test::distance(moved.position("tip.a"), {0.5, 1.1, 0}) < 1e-6);
}

TEST_CASE("modules ribbon on a surface: no places make no joints") {
  const test::Sash sash(test::sheet(tongue), 1);
  const test::Rig rig(waist("places: []"), sash.change(), true, sash.geometry());
  CHECK(rig.nodes("hips/ribbon.joint").empty());
}

TEST_CASE("modules ribbon on a surface: the same motion on every model") {
  const auto move = [](const test::Rig& rig, const Affine& by) {
    test::Pose pose(rig);
    for (int i = 0; i < 3; ++i)
      pose.move_to(tweak(i), pose.position(tweak(i)) + by.linear * Vec3{0.1, 0.1 * i, 0.2});
    return pin_motion(rig, pose);
  };
  const test::Sash sash(test::sheet(half_belt), 1);
  const test::Rig plain(waist(), sash.change(), true, sash.geometry());
  const auto expected = move(plain, {});
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Sash own(test::sheet(half_belt), 1);
    const test::Rig rig(waist(), own.change(model.by, model.change), true, own.geometry());
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    const auto rest = pins(rig, test::Pose(rig));
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const Vec3 place = half_belt(static_cast<double>(k) / 6, 0.5);
      CHECK(test::distance(rest[k].origin, model.by * place) <
            1e-9 * rig.skeleton.character.height);
      const Vec3 out = math::normalised(model.by.linear * Vec3{place.x, 0, place.z});
      CHECK(math::dot(math::normalised(rest[k].linear.y), out) > 0.997);
    }
    const auto moved = move(rig, model.by);
    const auto same = test::mapped(model.by, expected);
    for (std::size_t k = 0; k < moved.size(); ++k)
      CHECK(test::distance(moved[k] * rest[k].origin, same[k] * rest[k].origin) <
            1e-8 * rig.skeleton.character.height);
  }
}

TEST_CASE(
    "modules ribbon on a surface: pins at given places, along an edge, on joints of its own") {
  const test::Sash sash(test::sheet(tongue), 1);
  const test::Rig given(waist("places: [0.25, 0.9], row: 1, direction: u"), sash.change(), true,
                        sash.geometry());
  REQUIRE(given.clean());
  const auto at = pins(given, test::Pose(given));
  REQUIRE(at.size() == 2);
  CHECK(test::distance(at[0].origin, tongue(0.25, 1)) < 1e-4);
  CHECK(test::distance(at[1].origin, tongue(0.9, 1)) < 1e-4);
  const std::string riders =
      "  - {name: tip_a, parent: hips, at: [0, 1, 0.5], local: tip, label: a}\n"
      "  - {name: tip_b, parent: hips, at: [0, 1, 1], local: tip, label: b}\n";
  const test::Rig rig(waist("joints: [tip.a, tip.b]", riders), sash.change(), true,
                      sash.geometry());
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  pose.move_to(tweak(1), {0, 1.2, 0.5});
  CHECK(test::distance(pose.position("tip.a"), {0, 1.2, 0.5}) < 1e-9);
  CHECK(test::distance(pose.position("tip.b"), {0, 1, 1}) < 1e-9);
}

TEST_CASE("modules ribbon on a surface: a model without it gets no ribbon") {
  const test::Rig none(waist());
  CHECK(test::codes(none.diagnostics) == "RIG0895");
  CHECK(none.nodes("hips/ribbon.tweak").empty());
  CHECK(test::rest_error(none) < 1e-9);
  const test::Sash sash(test::sheet(tongue), 1);
  const test::Rig other(test::template_of(R"(joints:
  - name: hips
    at: [0, 1, 0]
    tags:
      - {command: ribbon, with: {surface: cape}}
  - {name: chest, parent: hips, at: [0, 2, 0]}
)"),
                        sash.change(), true, sash.geometry());
  CHECK(test::codes(other.diagnostics) == "RIG0895");
}

TEST_CASE("modules ribbon on a surface: what is wrong with a surface is said") {
  const auto said = [](tags::Surface surface) {
    const test::Sash sash(std::move(surface), 1);
    const test::Rig rig(waist(), sash.change(), true, sash.geometry());
    return test::text(rig.diagnostics);
  };
  tags::Surface surface;
  surface.trouble = "it is compressed";
  CHECK(said(surface).find("it is compressed") != std::string::npos);
  CHECK(said(surface).find("RIG0896") != std::string::npos);
  surface = test::sheet(tongue);
  for (auto& place : surface.texture) place = {0, 0};
  CHECK(said(surface).find("RIG0896") != std::string::npos);
  // Nothing of the rig moves it.
  const test::Sash sash(test::sheet(tongue), 1);
  const test::Rig rig(
      waist(),
      [&](tags::TaggedSkeleton& skeleton) {
        sash.change()(skeleton);
        skeleton.joints[1].foreign_node = 3;
      },
      true, sash.geometry());
  CHECK(test::codes(rig.diagnostics) == "RIG0896");
  CHECK(test::text(rig.diagnostics).find("no joint of this rig moves it") != std::string::npos);
}

TEST_CASE("modules ribbon on a surface: of two with a name the one that the rig moves") {
  const test::Sash sash(test::sheet(tongue), 1);
  const auto two = [&](bool both) {
    tags::Geometry out;
    out.surfaces = [=, one = sash.geometry().surfaces](const std::string& name) {
      std::vector<tags::Surface> found = one(name);
      found.push_back(found.front());
      if (!both) found.front().bound[0].first = 99;
      return found;
    };
    return out;
  };
  const test::Rig rig(waist(), sash.change(), true, two(false));
  INFO(test::text(rig.diagnostics));
  CHECK(rig.clean());
  CHECK(rig.nodes("hips/ribbon.joint").size() == 7);
  const test::Rig unclear(waist(), sash.change(), true, two(true));
  CHECK(test::codes(unclear.diagnostics) == "RIG0896");
  CHECK(test::text(unclear.diagnostics).find("2 nodes") != std::string::npos);
}

TEST_CASE("modules ribbon on a surface: it lies on joints or on a surface") {
  const test::Sash sash(test::sheet(tongue), 1);
  for (const std::string with : {"{surface: sash, along: [., hips.chest]}", "{count: 3}"}) {
    const test::Rig rig(test::template_of(R"(joints:
  - name: hips
    at: [0, 1, 0]
    local: hips
    label: hips
    tags:
      - {command: ribbon, with: )" + with +
                                          R"(}
  - {name: chest, parent: hips, at: [0, 2, 0], local: hips, label: chest}
)"),
                        sash.change(), true, sash.geometry());
    CHECK(test::codes(rig.diagnostics) == "RIG0897");
  }
}
