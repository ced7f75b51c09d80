// SPDX-License-Identifier: MIT
// The canonical text: what it looks like, and that every difference shows.
#include <doctest/doctest.h>

#include <functional>

#include "scene/edit.h"

namespace rigc {
namespace {

using scene::Edit;
using scene::Journal;
using scene::Kind;
using scene::Node;
using scene::NodeId;
using scene::Scene;
namespace transform = scene::transform;

struct Small {
  Scene scene;
  Journal journal;
  NodeId joint, control, point;

  explicit Small(const std::function<void(Edit&, Small&)>& change = {}) {
    Edit edit(scene, journal, nullptr);
    Node node;
    node.kind = Kind::control;
    node.name = "hand \"ctl\"";
    node.ids = {"hero", "arm_l", "wrist"};
    node.command = 3;
    node.origin = {{1, 12, 5, 4}, "hand_l", "control"};
    node.identity.role = "control";
    control = edit.make(node);
    joint = edit.make({});
    node = {};
    node.kind = Kind::point_constraint;
    node.command = 3;
    point = edit.make(node);
    edit.reparent(control, joint);
    edit.set({control, transform::kTranslate}, math::Vec3{0, 0.5, 0});
    edit.set({point, scene::constraint::kWeights, 0}, 1.0);
    edit.add_attribute(control, {.name = "roll", .value = 0.5, .min = 0, .max = 1});
    edit.connect({control, transform::kWorld}, {point, scene::constraint::kTargets, 0});
    if (change) change(edit, *this);
  }
};

TEST_CASE("scene dump: nodes of the skeleton first, then by command") {
  const Small small;
  CHECK(small.scene.dump() ==
        "node 0 transform \"\"\n"
        "  identity 0:0000000000000000\n"
        "  ids \"\" \"\" \"\"\n"
        "  children 1\n"
        "node 1 control \"hand \\\"ctl\\\"\"\n"
        "  identity " +
            to_text(small.scene[small.control].identity) +
            "\n"
            "  ids \"hero\" \"arm_l\" \"wrist\"\n"
            "  command 3\n"
            "  origin 12:5 \"hand_l\" \"control\"\n"
            "  parent 0\n"
            "  translate 0 0.5 0\n"
            "  user \"roll\" number 0.5 initial 0 min 0 max 1 keyable\n"
            "node 2 point_constraint \"\"\n"
            "  identity 0:0000000000000000\n"
            "  ids \"\" \"\" \"\"\n"
            "  command 3\n"
            "  targets[0] 1 0 0 0 1 0 0 0 1 0 0 0\n"
            "  weights[0] 1\n"
            "  targets[0] <- 1 world\n");
}

TEST_CASE("scene dump: every change shows") {
  const std::string plain = Small().scene.dump();
  const std::function<void(Edit&, Small&)> changes[] = {
      [](Edit& e, Small& s) {
        e.set({s.control, transform::kTranslate, -1, 0}, 1e-300);
      },
      [](Edit& e, Small& s) {
        e.set({s.control, transform::kVisible}, 0.0);
      },
      [](Edit& e, Small& s) {
        e.set({s.control, transform::kRotate}, math::Vec3{0, 1e-9, 0});
      },
      [](Edit& e, Small& s) {
        e.set({s.control, scene::control::kShape}, std::string("cube"));
      },
      [](Edit& e, Small& s) {
        e.set({s.control, scene::control::kPoints}, std::vector<double>{0});
      },
      [](Edit& e, Small& s) {
        e.set({s.control, scene::kUserAttributes}, 0.25);
      },
      [](Edit& e, Small& s) {
        e.set({s.point, scene::constraint::kWeights, 1}, 1.0);
      },
      [](Edit& e, Small& s) {
        e.set({s.point, scene::constraint::kOffsets, 0}, math::Affine{});
      },
      [](Edit& e, Small& s) { e.reparent(s.control, {}); },
      [](Edit& e, Small& s) {
        e.disconnect({s.point, scene::constraint::kTargets, 0});
      },
      [](Edit& e, Small& s) {
        e.connect({s.joint, transform::kWorld}, {s.point, scene::constraint::kTargets, 0});
      },
      [](Edit& e, Small& s) { e.add_attribute(s.joint, {.name = "x", .min = {}, .max = {}}); },
      [](Edit& e, Small&) { e.make({}); },
  };
  for (const auto& change : changes) CHECK(Small(change).scene.dump() != plain);
  CHECK(Small().scene.dump() == plain);
}

}  // namespace
}  // namespace rigc
