// SPDX-License-Identifier: MIT
// chain: FK with falloff, IK and a spline for tails, ears and ropes, blended.
// Test: tests/modules/chain_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/limbs/chain_ik.h"
#include "modules/limbs/curve.h"
#include "modules/limbs/two_bone.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
namespace constraint = scene::constraint;

struct Chain {
  std::vector<NodeId> joints;
  NodeId space;  ///< a control or transform that everything hangs under
  NodeId settings;
  std::vector<NodeId> fk;
  std::vector<NodeId> ik;         ///< transforms that the solver turns; empty without IK
  std::vector<Target> on_spline;  ///< empty without spline
};

ControlSpec look(const Builder& b, NodeId joint, const std::string& part) {
  ControlSpec spec;
  spec.joint = joint;
  spec.shape_parameter = part + "_shape";
  spec.shape = b.with().text(spec.shape_parameter);
  spec.size = b.with().number(part + "_size");
  spec.color = side_color(b, joint, "color");
  return spec;
}

math::Affine joint_frame(const Builder& b, NodeId joint) {
  const math::Affine at = rest(b, joint);
  return {math::orthonormal(at.linear), at.origin};
}

/// Between a control and the next one's zero: turns by a part of what the control before turns, and
/// of what came to it from those before that.
NodeId spread(Builder& b, const Chain& chain, std::size_t i, const math::Affine& frame,
              const Plug& falloff, std::optional<Plug>& passed_on) {
  const NodeId place = make_place(b, chain.joints[i], "falloff", chain.fk[i - 1], frame);
  std::vector<Given> given{{"rests", scene::Value(b.scene().local(place).rotation)},
                           {"still", scene::Value(math::Quat{})},
                           {"turn", Plug{chain.fk[i - 1], transform::kRotation}},
                           {"falloff", falloff}};
  if (passed_on) given.push_back({"before", *passed_on});
  const std::string turn = passed_on ? "before * turn" : "turn";
  const Computed made =
      compute(b, chain.joints[i], "falloff", given,
              "out spread = slerp(still, " + turn +
                  ", falloff); out turned = rests * slerp(still, " + turn + ", falloff);");
  b.connect(made["turned"], {place, transform::kRotation});
  passed_on = made["spread"];
  return place;
}

void make_settings(Builder& b, Chain& chain) {
  ControlSpec spec = look(b, chain.joints.front(), "settings");
  spec.role = "settings";
  const math::Mat3 axes = character_axes(b);
  spec.frame = {axes, position(b, spec.joint) + axes * b.with().vec3("settings_offset")};
  spec.space = chain.space;
  spec.facing = {0, 0, 1};
  spec.translate = spec.rotate = false;
  chain.settings = make_control(b, spec).control;
}

Plug add_part(Builder& b, const Chain& chain, const std::string& name) {
  return add_number(b, chain.settings,
                    {.name = name, .value = b.with().number(name), .min = 0, .max = 1});
}

void make_fk(Builder& b, Chain& chain) {
  const Plug falloff = add_part(b, chain, "falloff");
  std::optional<Plug> passed_on;
  for (std::size_t i = 0; i < chain.joints.size(); ++i) {
    const NodeId joint = chain.joints[i];
    const math::Vec3 direction = chain_direction(b, chain.joints, i);
    ControlSpec spec = look(b, joint, "fk");
    spec.role = "fk";
    spec.axes = AxesFrom::bone;
    spec.frame = {bone_frame(b, joint, direction), position(b, joint)};
    face(b, spec, "bone", direction);
    spec.space = i == 0 ? chain.space : spread(b, chain, i, spec.frame, falloff, passed_on);
    spec.translate = b.with().flag("translate");
    chain.fk.push_back(make_control(b, spec).control);
    if (b.failed()) return;
  }
}

/// The last joint goes where the IK control is and turns with it.
void make_ik(Builder& b, Chain& chain) {
  const NodeId last = chain.joints.back();
  ControlSpec spec = look(b, last, "ik");
  spec.role = "ik";
  spec.frame = {character_axes(b), position(b, last)};
  spec.space = space_from(b, "ik_parent", root_control(b));
  if (b.failed()) return;
  const NodeId control = make_control(b, spec).control;
  if (b.failed()) return;
  NodeId above = chain.space;
  for (const NodeId joint : chain.joints) {
    above = make_place(b, joint, "ik", above, joint_frame(b, joint));
    chain.ik.push_back(above);
  }
  const NodeId pole = straight_chain_pole(b, chain.joints, b.with().text("bend"));
  make_chain_ik(b, {chain.ik, chain.joints.front(), control, pole});
  const NodeId turn = make_constraint(b, scene::Kind::orient_constraint, chain.ik.back(),
                                      {target(b, control)}, {}, true, "space", last);
  b.connect({turn, constraint::kRotation}, {chain.ik.back(), transform::kRotation});
}

void make_spline(Builder& b, Chain& chain) {
  const auto count = static_cast<int>(b.with().number("spline_controls"));
  CurveSpec curve;
  curve.joint = chain.joints.front();
  curve.base = chain.space;
  curve.aims = true;
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / (count - 1);
    const math::Vec3 point = point_along(positions(b, chain.joints), part);
    ControlSpec spec = look(b, nearest_joint(b, chain.joints, point), "spline");
    spec.role = "tweak";
    spec.frame = {character_axes(b), point};
    spec.space = chain.space;
    curve.controls.push_back(make_control(b, spec).control);
    if (b.failed()) return;
  }
  curve.follows.assign(curve.controls.size(), b.with().number("spline_turns"));
  for (const NodeId joint : chain.joints) curve.places.push_back(joint_frame(b, joint));
  const Curve made = make_curve(b, curve);
  b.connect(formula(b, curve.joint, "preserve", "1 - $0", {add_part(b, chain, "stretch")}),
            {made.node, scene::spline::kPreserve});
  chain.on_spline = made.outputs;
}

struct Weights {
  Plug fk;
  std::optional<Plug> ik, spline;
};

/// Whatever share the spline leaves, IK and FK share.
Weights make_weights(Builder& b, const Chain& chain) {
  const NodeId joint = chain.joints.front();
  Weights weights;
  std::vector<Given> given;
  if (chain.ik.empty()) {
    given.push_back({"ik_fk", scene::Value(0.0)});
  } else {
    given.push_back({"ik_fk", add_part(b, chain, "ik_fk")});
  }
  if (chain.on_spline.empty()) {
    given.push_back({"spline", scene::Value(0.0)});
  } else {
    weights.spline = add_part(b, chain, "spline");
    given.push_back({"spline", *weights.spline});
  }
  const Computed made = compute(b, joint, "weights", given,
                                "out fk = (1 - ik_fk) * (1 - spline);"
                                "out ik = ik_fk * (1 - spline);");
  weights.fk = made["fk"];
  if (!chain.ik.empty()) weights.ik = made["ik"];
  return weights;
}

/// A transform that goes where FK, IK and spline say by their weights, and the joint with it.
void follow(Builder& b, const Chain& chain, std::size_t i, const Weights& weights) {
  const NodeId joint = chain.joints[i];
  std::vector<Target> targets{target(b, chain.fk[i])};
  std::vector<Plug> shares{weights.fk};
  if (weights.ik) targets.push_back(target(b, chain.ik[i])), shares.push_back(*weights.ik);
  if (weights.spline) targets.push_back(chain.on_spline[i]), shares.push_back(*weights.spline);
  const NodeId blend = make_place(b, joint, "blend", chain.space, joint_frame(b, joint));
  std::vector<double> initial;
  const double ik = weights.ik ? b.with().number("ik_fk") : 0;
  const double spline = weights.spline ? b.with().number("spline") : 0;
  initial.push_back((1 - ik) * (1 - spline));
  if (weights.ik) initial.push_back(ik * (1 - spline));
  if (weights.spline) initial.push_back(spline);
  const NodeId rides = ride(b, blend, targets, initial);
  for (std::size_t k = 0; k < shares.size(); ++k)
    b.connect(shares[k], {rides, constraint::kWeights, static_cast<std::int32_t>(k)});
  ControlSpec spec;
  spec.joint = joint;
  spec.space = chain.space;
  drive(b, spec, blend);
}

}  // namespace

void chain(Builder& b) {
  const Parameters& with = b.with();
  Chain chain;
  chain.joints = with.nodes("joints");
  if (chain.joints.size() < 2) {
    b.fail(codes::kTooFewJoints, "joints",
           fmt::format("a chain needs at least two joints, not {}", chain.joints.size()));
    return;
  }
  const NodeId named = space_from(b, "parent", space_of(b, chain.joints.front()));
  if (b.failed() || !check_order(b, chain.joints, "joints")) return;
  chain.space = stand_on(b, named, chain.joints.front());
  make_settings(b, chain);
  if (!b.failed()) make_fk(b, chain);
  if (!b.failed() && with.flag("ik")) make_ik(b, chain);
  if (!b.failed() && with.number("spline_controls") >= 2) make_spline(b, chain);
  if (b.failed()) return;
  const Weights weights = make_weights(b, chain);
  for (std::size_t i = 0; i < chain.joints.size(); ++i) follow(b, chain, i, weights);
}

}  // namespace rigc::modules
