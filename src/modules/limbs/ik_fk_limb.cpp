// SPDX-License-Identifier: MIT
// ik_fk_limb: an FK chain, an IK control with a pole, and a switch that blends them.
// Test: tests/modules/ik_fk_limb_test.cpp
#include <algorithm>
#include <array>

#include "modules/codes.h"
#include "modules/limbs/limb_match.h"
#include "modules/limbs/two_bone.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;

/// What a limb is made of, start to end.
struct Limb {
  TwoBone bones;
  std::vector<NodeId> joints;  ///< three
  NodeId space;                ///< what the FK chain hangs on
  std::array<NodeId, 3> fk;
  NodeId ik, goal, pole, settings, solver;
  Plug ik_weight, fk_weight;
};

/// Shape, size and colour parameters that begin with `part`.
ControlSpec look(const Builder& b, NodeId joint, const std::string& part) {
  ControlSpec spec;
  spec.joint = joint;
  spec.role = part;
  spec.shape_parameter = part + "_shape";
  spec.shape = b.with().text(spec.shape_parameter);
  spec.size = b.with().number(part + "_size");
  spec.color = side_color(b, joint, part + "_color");
  return spec;
}

void make_fk(Builder& b, Limb& limb) {
  limb.space = space_from(b, "parent", space_of(b, limb.joints[0]));
  NodeId space = limb.space;
  for (std::size_t i = 0; i < 3 && !b.failed(); ++i) {
    const NodeId joint = limb.joints[i];
    ControlSpec spec = look(b, joint, "fk");
    const math::Vec3 direction = chain_direction(b, limb.joints, i);
    spec.frame = {i == 1 ? hinge_frame(b, limb.bones, direction) : bone_frame(b, joint, direction),
                  position(b, joint)};
    spec.axes = AxesFrom::bone;
    face(b, spec, "bone", direction);
    spec.space = space;
    spec.translate = false;
    limb.fk[i] = make_control(b, spec).control;
    space = limb.fk[i];
  }
}

void make_ik(Builder& b, Limb& limb) {
  const Parameters& with = b.with();
  const NodeId space = space_from(b, "ik_parent", root_control(b));
  if (b.failed()) return;
  ControlSpec spec = look(b, limb.joints[2], "ik");
  spec.offset = with.vec3("ik_offset");
  spec.frame = oriented(b, limb.joints[2], with.text("ik_orient"));
  spec.axes = axes_from(with.text("ik_orient"));
  spec.space = space;
  limb.ik = make_control(b, spec).control;
  if (b.failed()) return;
  limb.goal = b.make({.kind = scene::Kind::transform,
                      .role = "driver",
                      .joint = limb.joints[2],
                      .parent = limb.ik,
                      .suffix = "goal"});
  spec = look(b, limb.joints[1], "pole");
  spec.frame = {character_axes(b),
                pole_position(b, limb.bones, with.number("pole_distance") * limb.bones.length)};
  spec.space = space;
  spec.rotate = false;
  limb.pole = make_control(b, spec).control;
}

/// The settings control rides on the end joint; its `ik_fk` gives both weights.
void make_settings(Builder& b, Limb& limb) {
  const Parameters& with = b.with();
  ControlSpec spec = look(b, limb.joints[2], "settings");
  const math::Mat3 axes = character_axes(b);
  spec.frame = {axes, position(b, limb.joints[2]) + axes * with.vec3("settings_offset")};
  spec.space = limb.joints[2];
  spec.facing = {0, 0, 1};
  spec.translate = spec.rotate = false;
  limb.settings = make_control(b, spec).control;
  if (b.failed()) return;

  limb.ik_weight = add_number(b, limb.settings,
                              {.name = "ik_fk", .value = with.number("ik_fk"), .min = 0, .max = 1});
  limb.fk_weight = formula(b, limb.joints[2], "fk_weight", "1 - $0", {limb.ik_weight});
}

/// Turns of the upper and the lower bone about themselves, which goal and pole cannot say. Equal
/// values on both sides of a character mirror each other.
void add_twist(Builder& b, const Limb& limb, std::size_t i) {
  Plug plug = add_number(b, limb.ik,
                         {.name = i == 0 ? "upper_twist" : "lower_twist",
                          .flavour = scene::UserAttribute::Flavour::angle});
  if (is_mirrored(b, limb.joints[i])) plug = formula(b, limb.joints[i], "twist", "-$0", {plug});
  add_turn(b, {limb.solver, i == 0 ? scene::ik2::kStartTwist : scene::ik2::kMiddleTwist}, plug);
}

/// Each joint turns with its FK control and with what IK says, by weight.
void blend(Builder& b, const Limb& limb) {
  namespace constraint = scene::constraint;
  const double ik_fk = b.with().number("ik_fk");
  const Target solved[3] = {{{limb.solver, scene::ik2::kStartWorld}, rest(b, limb.joints[0])},
                            {{limb.solver, scene::ik2::kMiddleWorld}, rest(b, limb.joints[1])},
                            target(b, limb.goal)};
  for (std::size_t i = 0; i < 3; ++i) {
    const NodeId joint = limb.joints[i];
    const NodeId node = make_constraint(b, scene::Kind::orient_constraint, joint,
                                        {target(b, limb.fk[i]), solved[i]}, {1 - ik_fk, ik_fk},
                                        true, "driver", joint);
    b.connect(limb.fk_weight, {node, constraint::kWeights, 0});
    b.connect(limb.ik_weight, {node, constraint::kWeights, 1});
    b.connect({node, constraint::kRotation}, {joint, transform::kRotation});
  }
}

/// What a joint that the skeleton does not take along keeps its place under: the joint before, and
/// the translation of the FK control, which so moves it off its place in FK and in IK. Clips of
/// models whose feet hang under the root do that.
NodeId moved_place(Builder& b, const Limb& limb, std::size_t i) {
  const NodeId zero =
      make_place(b, limb.joints[i], "place_zero", limb.joints[i - 1], rest(b, limb.fk[i]));
  const NodeId place = b.make({.kind = scene::Kind::transform,
                               .role = "space",
                               .joint = limb.joints[i],
                               .parent = zero,
                               .suffix = "place"});
  b.connect({limb.fk[i], transform::kTranslate}, {place, transform::kTranslate});
  return place;
}

/// Lengths stay: a joint that the skeleton does not take along (a foot that hangs under the root)
/// keeps its place seen from the joint before, the first from what the FK chain hangs on.
void carry_joints(Builder& b, const Limb& limb) {
  for (std::size_t i = 0; i < 3; ++i) {
    const NodeId before = i == 0 ? limb.space : limb.joints[i - 1];
    if (carried_by(b, limb.joints[i], before)) continue;
    carry(b, limb.joints[i], i == 0 ? limb.fk[0] : moved_place(b, limb, i));
  }
}

/// Controls that have no part in the pose are not shown.
void hide_unused(Builder& b, const Limb& limb) {
  const Plug fk = formula(b, limb.joints[2], "fk_shown", "$0 < 1", {limb.ik_weight});
  const Plug ik = formula(b, limb.joints[2], "ik_shown", "$0 > 0", {limb.ik_weight});
  for (const NodeId control : limb.fk) b.connect(fk, {control, transform::kVisible});
  for (const NodeId control : {limb.ik, limb.pole}) b.connect(ik, {control, transform::kVisible});
}

void describe_match(Builder& b, const Limb& limb) {
  LimbParts parts;
  std::copy(limb.joints.begin(), limb.joints.end(), parts.joints.begin());
  parts.fk = limb.fk;
  parts.ik = limb.ik;
  parts.pole = limb.pole;
  parts.settings = limb.settings;
  parts.solver = limb.solver;
  parts.ik_weight = limb.ik_weight;
  make_match(b, parts,
             {{"upper_twist", *b.scene().find_plug(limb.ik, "upper_twist")},
              {"lower_twist", *b.scene().find_plug(limb.ik, "lower_twist")}});
}

}  // namespace

void ik_fk_limb(Builder& b) {
  const Parameters& with = b.with();
  Limb limb;
  limb.joints = {with.node("start"), with.node("middle"), with.node("end")};
  if (!check_order(b, {limb.joints[0], limb.joints[1]}, "middle")) return;
  if (!check_order(b, limb.joints, "end")) return;
  limb.bones =
      measure_two_bone(b, limb.joints[0], limb.joints[1], limb.joints[2], with.text("bend"));
  if (b.failed()) return;
  make_fk(b, limb);
  if (!b.failed()) make_ik(b, limb);
  if (!b.failed()) make_settings(b, limb);
  if (b.failed()) return;
  limb.solver = make_two_bone(b, limb.bones, limb.goal, limb.pole, 0);
  for (const std::size_t i : {0u, 1u}) add_twist(b, limb, i);
  blend(b, limb);
  carry_joints(b, limb);
  if (with.flag("hide")) hide_unused(b, limb);
  describe_match(b, limb);
}

}  // namespace rigc::modules
