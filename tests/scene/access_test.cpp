// SPDX-License-Identifier: MIT
// Bits of what animators may do with a control's attributes.
#include "scene/access.h"

#include <doctest/doctest.h>

#include "scene/edit.h"

namespace rigc {
namespace {

using scene::component_bits;
using scene::NodeId;
namespace transform = scene::transform;
namespace control = scene::control;

struct Controls {
  scene::Scene scene;
  scene::Journal journal;
  scene::Edit edit{scene, journal, nullptr};
  NodeId make(scene::Kind kind) {
    scene::Node node;
    node.kind = kind;
    return edit.make(std::move(node));
  }
};

TEST_CASE("scene access: every component has a bit and a name") {
  const NodeId node{0};
  CHECK(component_bits({node, transform::kTranslate}) == scene::kTranslateBits);
  CHECK(component_bits({node, transform::kRotation}) == scene::kRotateBits);
  CHECK(component_bits({node, transform::kRotate}) == scene::kRotateBits);
  CHECK(component_bits({node, transform::kScale}) == scene::kScaleBits);
  const std::uint16_t attributes[] = {transform::kTranslate, transform::kRotate, transform::kScale};
  unsigned bit = 1;
  for (const std::uint16_t attribute : attributes) {
    for (std::int8_t c = 0; c < 3; ++c, bit *= 2)
      CHECK(component_bits({node, attribute, -1, c}) == bit);
  }
  CHECK(scene::component_name(0) == "translate.x");
  CHECK(scene::component_name(4) == "rotate.y");
  CHECK(scene::component_name(8) == "scale.z");
  // One number of a quaternion is nothing that animators know.
  CHECK(component_bits({node, transform::kRotation, -1, 0}) == 0);
  CHECK(component_bits({node, transform::kVisible}) == 0);
  CHECK(component_bits({node, transform::kWorld}) == 0);
  CHECK(component_bits({node, control::kColor, -1, 1}) == 0);
  CHECK(component_bits({node, scene::kUserAttributes}) == 0);
}

TEST_CASE("scene access: keyable is what is neither switched off nor locked") {
  Controls c;
  const NodeId node = c.make(scene::Kind::control);
  CHECK(scene::keyable_bits(c.scene, node) == 511);
  c.edit.set({node, control::kKeyable}, 3.0);
  CHECK(scene::keyable_bits(c.scene, node) == 63);
  c.edit.set({node, control::kLocked}, 2.0 + 64);
  CHECK(scene::keyable_bits(c.scene, node) == 61);
  for (const double lie : {-1.0, 512.0, 1e300}) {
    c.edit.set({node, control::kLocked}, lie);
    CHECK(scene::keyable_bits(c.scene, node) == 63);
  }
}

TEST_CASE("scene access: connections decide components, a quaternion all its angles") {
  Controls c;
  const NodeId a = c.make(scene::Kind::control), b = c.make(scene::Kind::control);
  CHECK(scene::driven_bits(c.scene, b) == 0);
  c.edit.connect({a, transform::kTranslate, -1, 0}, {b, transform::kScale, -1, 2});
  CHECK(scene::driven_bits(c.scene, b) == 256);
  c.edit.connect({a, transform::kTranslate, -1, 0}, {b, transform::kRotation, -1, 3});
  CHECK(scene::driven_bits(c.scene, b) == 256 + scene::kRotateBits);
  c.edit.connect({a, transform::kVisible}, {b, transform::kVisible});
  CHECK(scene::driven_bits(c.scene, b) == 256 + scene::kRotateBits);
}

TEST_CASE("scene access: access to a user attribute is changed and taken back") {
  Controls c;
  const NodeId node = c.make(scene::Kind::control);
  const scene::Plug plug = c.edit.add_attribute(node, {"roll", {}, 1, 1, {}, {}});
  const std::string before = c.scene.dump();
  scene::Journal journal;
  scene::Edit edit(c.scene, journal, nullptr);
  edit.set_access(plug, false, true);
  CHECK_FALSE(c.scene[node].user[0].keyable);
  CHECK(c.scene[node].user[0].hidden);
  CHECK(c.scene.dump() != before);
  scene::Edit::undo(c.scene, journal, nullptr);
  CHECK(c.scene.dump() == before);
}

}  // namespace
}  // namespace rigc
