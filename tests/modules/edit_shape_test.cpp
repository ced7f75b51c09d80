// SPDX-License-Identifier: MIT
// edit_shape: a control looks another way and is the same control; the mirrored side mirrors.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

std::string hips(const std::string& edit) {
  return test::body({{"hips",
                      "{command: control, with: {shape: square, size: 0.4, offset: [0, 0.1, 0], "
                      "axis: z}}\n{command: edit_shape, with: {control: ./control, " +
                          edit + "}}"}});
}

std::vector<Vec3> points(const test::Rig& rig, const std::string& selector) {
  const auto& numbers = std::get<std::vector<double>>(
      rig.scene()[rig.node(selector)].attributes[scene::control::kPoints][0]);
  std::vector<Vec3> out;
  for (std::size_t at = 0; at < numbers.size();)
    for (auto left = static_cast<std::size_t>(numbers[at++]); left > 0; --left, at += 3)
      out.push_back({numbers[at], numbers[at + 1], numbers[at + 2]});
  return out;
}

struct Box {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  explicit Box(const std::vector<Vec3>& points) {
    for (const Vec3& p : points)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], p[i]);
        high[i] = std::max(high[i], p[i]);
      }
  }
};

bool near(Vec3 a, Vec3 b, double within = 1e-4) { return test::distance(a, b) < within; }

const std::string kHips = "torso.hips/control";

}  // namespace

TEST_CASE("modules edit_shape: size and offset are about the shape's own middle") {
  const test::Rig plain(hips("size: 1"));
  INFO(test::text(plain.diagnostics));
  REQUIRE(plain.clean());
  const Box before(points(plain, kHips));
  const test::Rig edited(hips("size: 2, offset: [0.5, 0, 0]"));
  REQUIRE(edited.clean());
  const Box after(points(edited, kHips));
  const Vec3 middle = (before.low + before.high) * 0.5, half = before.high - middle;
  CHECK(near(middle, {0, 0.1, 0}));
  CHECK(near(after.low, middle + Vec3{0.5, 0, 0} - half * 2));
  CHECK(near(after.high, middle + Vec3{0.5, 0, 0} + half * 2));
}

TEST_CASE("modules edit_shape: another shape takes the place, size and facing of the first") {
  const test::Rig as_circle(hips("shape: circle"));
  INFO(test::text(as_circle.diagnostics));
  REQUIRE(as_circle.clean());
  const test::Rig circle(test::body(
      {{"hips",
        "{command: control, with: {shape: circle, size: 0.4, offset: [0, 0.1, 0], axis: z}}"}}));
  REQUIRE(circle.clean());
  const auto a = points(as_circle, kHips), b = points(circle, kHips);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(near(a[i], b[i], 1e-3));
  const auto& node = as_circle.scene()[as_circle.node(kHips)];
  CHECK(std::get<std::string>(node.attributes[scene::control::kShape][0]) == "circle");
}

TEST_CASE("modules edit_shape: a turned shape is turned, its colour is the new one") {
  const test::Rig edited(hips("rotate: [90, 0, 0], color: [0, 1, 0]"));
  REQUIRE(edited.clean());
  const Box box(points(edited, kHips));
  CHECK(box.high.y - box.low.y < 1e-3);  // it faced along z, now along -y
  CHECK(box.high.z - box.low.z > 0.3);
  const auto& node = edited.scene()[edited.node(kHips)];
  CHECK(std::get<Vec3>(node.attributes[scene::control::kColor][0]) == Vec3{0, 1, 0});
}

TEST_CASE("modules edit_shape: equal values on both sides mirror, on any model") {
  const std::string arms = test::template_of(R"(joints:
  - {name: body, at: [0, 1, 0], local: torso, label: body}
  - {name: arm_l, parent: body, at: [0.3, 1, 0], local: arm_l, label: arm, tags: [
      {command: control, with: {shape: pin, size: 0.2, orient: bone}},
      {command: edit_shape, with: {control: ./control, size: 1.5, offset: [0.1, 0.02, 0.03], rotate: [0, 30, 0]}}]}
  - {name: arm_r, parent: body, at: [-0.3, 1, 0], local: arm_r, label: arm, tags: [
      {command: control, with: {shape: pin, size: 0.2, orient: bone}},
      {command: edit_shape, with: {control: ./control, size: 1.5, offset: [0.1, 0.02, 0.03], rotate: [0, 30, 0]}}]}
)");
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(arms, [&](tags::TaggedSkeleton& skeleton) {
      test::mirror_right_side(skeleton);
      if (model.change) model.change(skeleton);
    });
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    const auto left = points(rig, "arm_l/control"), right = points(rig, "arm_r/control");
    REQUIRE(left.size() == right.size());
    const tags::Character& character = rig.skeleton.character;
    const math::Affine l = rig.rest("arm_l/control"), r = rig.rest("arm_r/control");
    const Vec3 middle = rig.rest("torso.body").origin;
    for (std::size_t i = 0; i < left.size(); ++i) {
      Vec3 image = l * left[i] - middle;
      image = image - character.left * (2 * math::dot(character.left, image));
      CHECK(near(image + middle, r * right[i], 1e-3 * character.height));
    }
  }
}

TEST_CASE("modules edit_shape: a shape that nobody has is refused at its parameter") {
  const test::Rig rig(hips("shape: squar"));
  CHECK(test::codes(rig.diagnostics) == "RIG0462");
  CHECK(test::text(rig.diagnostics).find("square") != std::string::npos);
}
