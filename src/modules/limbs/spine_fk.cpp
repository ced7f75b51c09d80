// SPDX-License-Identifier: MIT
// spine_fk: hips that turn alone, FK controls up the spine, the chest last.
// Test: tests/modules/spine_fk_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

/// The spine's first zero moves with the hips but turns with what both hang under, so that turning
/// the hips bends the spine at its base and stretches nothing.
void carry_base(Builder& b, NodeId zero, NodeId hips) {
  const NodeId node = make_constraint(b, scene::Kind::parent_constraint, zero, {target(b, hips)},
                                      {}, true, "space");
  b.connect({node, scene::constraint::kTranslate}, {zero, scene::transform::kTranslate});
}

/// What hips and spine hang under as children: the space itself, or, for a joint, a transform that
/// follows it, because the spine's base gets its position from the hips.
NodeId stand_on(Builder& b, NodeId space, NodeId hips) {
  if (!space.valid() || b.scene()[space].kind != scene::Kind::joint) return space;
  return make_place(b, hips, "stand", space, {character_axes(b), position(b, hips)});
}

}  // namespace

void spine_fk(Builder& b) {
  const Parameters& with = b.with();
  const std::vector<NodeId>& joints = with.nodes("joints");
  if (joints.size() < 2) {
    b.fail(codes::kTooFewJoints, "joints",
           fmt::format("a spine needs at least two joints, not {}", joints.size()));
    return;
  }
  const NodeId named = space_from(b, "parent", space_of(b, joints.front()));
  if (b.failed() || !check_order(b, joints, "joints")) return;
  const NodeId space = stand_on(b, named, joints.front());
  ControlSpec spec;
  face(b, spec, with.text("axis"), {});
  NodeId hips;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const bool first = i == 0;
    const bool last = i + 1 == joints.size();
    const std::string part = first ? "hips" : last ? "chest" : "fk";
    spec.joint = joints[i];
    spec.role = part;
    spec.frame = oriented(b, joints[i], "character");
    spec.space = i <= 1 ? space : spec.space;
    spec.shape_parameter = part + "_shape";
    spec.shape = with.text(spec.shape_parameter);
    spec.size = with.number(part + "_size");
    const std::string own_color = part + "_color";
    spec.color = with.vec3(part != "fk" && with.has(own_color) ? own_color : "color");
    spec.translate = first;
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) return;
    if (first) hips = made.control;
    if (i == 1) {
      carry_base(b, made.zero, hips);
      spec.space = hips;  // takes the joint along
    }
    drive(b, spec, made.control);
    spec.space = made.control;
  }
}

}  // namespace rigc::modules
