// SPDX-License-Identifier: MIT
// proxy_mesh: one piece for each joint, around its bone, on every model.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// One row of scene::mesh::kParts, in rig space.
struct Piece {
  int style = 0;
  Vec3 head, tail, side;
  double width = 0, depth = 0;
};

constexpr std::size_t kRow = 15;

std::vector<Piece> pieces(const test::Rig& rig, const std::string& selector) {
  const scene::NodeId mesh = rig.node(selector);
  const auto parts = std::get<std::vector<double>>(rig.scene().value({mesh, scene::mesh::kParts}));
  std::vector<Piece> out;
  for (std::size_t at = 0; at + kRow <= parts.size(); at += kRow) {
    const auto element = static_cast<std::int32_t>(out.size());
    const auto source = rig.scene().source({mesh, scene::mesh::kJoints, element});
    REQUIRE(source);
    const math::Affine joint = rig.scene().rest_world(source->node);
    const auto vector = [&](std::size_t i) {
      return Vec3{parts[at + i], parts[at + i + 1], parts[at + i + 2]};
    };
    const double size = math::length(joint.linear.x);
    out.push_back({static_cast<int>(parts[at]), joint * vector(1), joint * vector(4),
                   joint.linear * vector(7), parts[at + 10] * size, parts[at + 11] * size});
  }
  REQUIRE(out.size() * kRow == parts.size());
  return out;
}

}  // namespace

TEST_CASE("modules proxy_mesh: every joint of the skeleton has a piece unless some are named") {
  const test::Rig all(test::body({{"root", "{command: proxy_mesh, with: {}}"}}));
  REQUIRE(all.clean());
  CHECK(pieces(all, "root/proxy_mesh").size() == all.skeleton.joints.size());
  const test::Rig some(
      test::body({{"root", "{command: proxy_mesh, with: {joints: [arm_l, arm_r]}}"}}));
  CHECK(pieces(some, "root/proxy_mesh").size() == 8);
}

TEST_CASE("modules proxy_mesh: pieces lie along the bones, at the same places on every model") {
  const std::string text = test::body({{"root", "{command: proxy_mesh, with: {}}"}});
  const test::Rig plain(text);
  const auto expected = pieces(plain, "root/proxy_mesh");
  const Vec3 elbow = plain.rest("arm_l.lower").origin;
  bool found = false;
  for (const Piece& piece : expected) {
    found = found || (test::distance(piece.head, plain.rest("arm_l.upper").origin) < 1e-9 &&
                      test::distance(piece.tail, elbow) < 1e-9);
  }
  CHECK(found);
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(text, model.change);
    const auto seen = pieces(rig, "root/proxy_mesh");
    REQUIRE(seen.size() == expected.size());
    const double height = rig.skeleton.character.height;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      CHECK(seen[i].style == expected[i].style);
      CHECK(test::distance(seen[i].head, model.by * expected[i].head) < 1e-9 * height);
      CHECK(test::distance(seen[i].tail, model.by * expected[i].tail) < 1e-9 * height);
      const double scale = height / plain.skeleton.character.height;
      CHECK(std::abs(seen[i].width - expected[i].width * scale) < 1e-9 * height);
      CHECK(std::abs(seen[i].depth - expected[i].depth * scale) < 1e-9 * height);
      CHECK(std::abs(math::dot(math::normalised(seen[i].side),
                               math::normalised(model.by.linear * expected[i].side))) > 1 - 1e-9);
    }
  }
}

TEST_CASE("modules proxy_mesh: style says the form") {
  const auto styles = [](const std::string& style) {
    const test::Rig rig(
        test::tail(3, {{"base", "{command: proxy_mesh, with: {style: " + style + "}}"}}));
    std::string out;
    for (const Piece& piece : pieces(rig, "base/proxy_mesh")) out += "cby"[piece.style];
    return out;
  };
  CHECK(styles("box") == "bbbb");
  CHECK(styles("capsule") == "cccc");
  CHECK(styles("cylinder") == "yyyy");
  CHECK(styles("auto") == "cccb");
}
