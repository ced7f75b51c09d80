// SPDX-License-Identifier: MIT
// foot_roll: the foot of a limb rolls on heel, ball, tip and edges by attributes of its IK control;
// the toes stay on the ground. Test: tests/modules/foot_roll_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/layers.h"
#include "modules/limbs/limb_match.h"
#include "modules/limbs/sole.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

using math::Vec3;
using scene::Value;
namespace transform = scene::transform;

/// What rolls, from the IK control down: base, at rest on the ground; sole, which stands on the
/// pivot of the moment; ball, about which the foot turns over the toes.
struct Foot {
  LimbParts limb;
  NodeId control;  ///< that the foot stands under and that has the attributes
  NodeId carrier;  ///< what it carries, and the goal with it
  NodeId toes;     ///< control; invalid without
  Sole sole;
  NodeId base, standing, ball;
  std::vector<Given> attributes;
};

NodeId make_under(Builder& b, const Foot& foot, const std::string& suffix, NodeId parent, Vec3 at) {
  const NodeId node = b.make({.kind = scene::Kind::transform,
                              .role = "driver",
                              .joint = foot.limb.joints[2],
                              .parent = parent,
                              .suffix = suffix});
  b.set({node, transform::kTranslate}, at);
  return node;
}

void add_attributes(Builder& b, Foot& foot) {
  const auto add = [&](const std::string& name, double value, std::optional<double> least,
                       std::optional<double> most) {
    if (b.failed()) return;
    foot.attributes.emplace_back(name, add_to(b, foot.control,
                                              {.name = name,
                                               .value = value,
                                               .min = least,
                                               .max = most,
                                               .flavour = scene::UserAttribute::Flavour::angle},
                                              "limb"));
  };
  add("roll", 0, {}, {});
  add("roll_break", b.with().number("roll_break"), 0, 180);
  add("roll_straight", b.with().number("roll_straight"), 0, 180);
  add("bank", 0, {}, {});
  add("toe_tap", 0, {}, {});
  add("toe_lift", 0, {}, {});
  for (const char* spin : {"heel_spin", "ball_spin", "toe_spin"}) add(spin, 0, {}, {});
}

/// Spins turn about upright axes on the level sole and so come first; then the sole tilts over
/// heel, tip or an edge. Over each of these nothing of it reaches out, so none of them pushes it
/// into the ground whatever the others do; where it gets steep the foot lifts onto what lies above
/// the edge. The hinge over which the foot rises from its toes slides
/// forward from the ball with what of the foot lies before it.
constexpr const char* kStanding = R"(
straightened = clamp((roll - roll_break) / max(roll_straight - roll_break, 0.001), 0, 1) * bends
             + (1 - bends);
spun = frame(heel, axis_angle(up, heel_spin))
     * frame(tip - heel, axis_angle(up, toe_spin))
     * frame(ball - tip, axis_angle(up, ball_spin));
over_tip = max(roll, 0) * straightened + toe_lift;
steepest = max(max(over_tip, 0 - roll), abs(bank));
lifted = vector(0, lift * sin(clamp(steepest - edge_tilt, 0, 90)), 0);
tilted = spun
       * frame(heel - ball, axis_angle(side, min(roll, 0)))
       * frame(tip - heel, axis_angle(side, over_tip))
       * frame(outer - tip, axis_angle(ahead, max(bank, 0)))
       * frame(inner - outer, axis_angle(ahead, min(bank, 0)));
out at = tilted * (ball - inner) + lifted;
out turn = rotation(tilted);
rise = max(roll, 0) * (1 - straightened);
risen = axis_angle(side, rise);
hinge = vector(0, 0, min(hinge_slide * rise, hinge_end));
out over_toes = risen;
out hinged = knuckle + hinge - risen * hinge;
out tap = axis_angle(side, 0 - toe_tap);
)";

Computed wire(Builder& b, const Foot& foot) {
  const Sole& sole = foot.sole;
  const double out = sole.outward;
  std::vector<Given> given = foot.attributes;
  given.emplace_back("bends", Value(foot.toes.valid() ? 1.0 : 0.0));
  given.emplace_back("side", Value(Vec3{1, 0, 0}));
  given.emplace_back("up", Value(Vec3{0, out, 0}));
  given.emplace_back("ahead", Value(Vec3{0, 0, -out}));
  given.emplace_back("heel", Value(Vec3{0, 0, sole.heel}));
  given.emplace_back("tip", Value(Vec3{0, 0, sole.tip}));
  given.emplace_back("ball", Value(Vec3{}));
  given.emplace_back("knuckle", Value(Vec3{0, sole.ball, 0}));
  given.emplace_back("hinge_slide", Value(sole.hinge_slide));
  given.emplace_back("hinge_end", Value(sole.hinge));
  given.emplace_back("lift", Value(sole.lift));
  given.emplace_back("edge_tilt", Value(kEdgeTilt));
  given.emplace_back("outer", Value(Vec3{out > 0 ? sole.high : sole.low, 0, 0}));
  given.emplace_back("inner", Value(Vec3{out > 0 ? sole.low : sole.high, 0, 0}));
  return compute(b, foot.limb.joints[2], "roll", given, kStanding);
}

/// The toes' control rides on the foot as before; in IK it turns with the sole, which stays on the
/// ground where the foot rolls over the ball. Who keys the limb otherwise keys it too.
void hold_toes(Builder& b, const Foot& foot, NodeId tapped) {
  namespace constraint = scene::constraint;
  const NodeId zero = zero_of(b, foot.toes);
  const double ik = b.scene().number(foot.limb.ik_weight);
  const NodeId node = make_constraint(b, scene::Kind::orient_constraint, zero,
                                      {target(b, foot.limb.joints[2]), target(b, tapped)},
                                      {1 - ik, ik}, true, "driver", owner(b, foot.toes));
  b.connect(foot.limb.fk_weight, {node, constraint::kWeights, 0});
  b.connect(foot.limb.ik_weight, {node, constraint::kWeights, 1});
  b.reconnect({node, constraint::kRotation}, {zero, transform::kRotation});
  add_held(b, foot.limb.match, foot.toes);
}

/// The control that the foot rolls under; fails where it does not carry the goal.
bool find_control(Builder& b, Foot& foot) {
  foot.control = b.with().has("control") ? b.with().node("control") : foot.limb.ik;
  foot.carrier = carrier_below(b, foot.control, foot.limb);
  if (foot.carrier.valid()) return true;
  b.fail(codes::kNotAbove, "control",
         fmt::format("{} does not carry where the limb goes in IK",
                     traversal::describe(b.scene(), foot.control)),
         "name the IK control, or a control that it hangs under");
  return false;
}

}  // namespace

void foot_roll(Builder& b) {
  Foot foot;
  foot.limb = limb_from(b, "limb");
  if (b.failed() || !find_control(b, foot)) return;
  if (b.with().has("toes")) foot.toes = b.with().node("toes");
  foot.sole = measure_sole(b, foot_joints(b, foot.limb.joints[2]));
  add_attributes(b, foot);
  if (b.failed()) return;
  report_sole(b, foot.control, foot.sole);

  foot.base = make_under(b, foot, "foot", foot.control, {});
  hang(b, foot.base, foot.control, foot.sole.frame);
  foot.standing = make_under(b, foot, "sole", foot.base, {});
  const Vec3 ball{0, foot.sole.ball, 0};
  foot.ball = make_under(b, foot, "ball", foot.standing, ball);
  const math::Affine stays = rest(b, foot.carrier);
  hang(b, foot.carrier, foot.ball, stays);

  const Computed rolled = wire(b, foot);
  b.connect(rolled["at"], {foot.standing, transform::kTranslate});
  b.connect(rolled["turn"], {foot.standing, transform::kRotation});
  b.connect(rolled["over_toes"], {foot.ball, transform::kRotation});
  b.connect(rolled["hinged"], {foot.ball, transform::kTranslate});
  if (!foot.toes.valid()) return;
  const NodeId tapped = make_under(b, foot, "toes", foot.standing, ball);
  b.connect(rolled["tap"], {tapped, transform::kRotation});
  hold_toes(b, foot, tapped);
}

}  // namespace rigc::modules
