// SPDX-License-Identifier: MIT
// spine_ik: a spine on a curve between hips and chest, with FK controls on top of it.
// Test: tests/modules/spine_ik_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/limbs/curve.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace constraint = scene::constraint;

/// How much the curve's direction turns with a middle control; the rest comes from its neighbours.
constexpr double kMiddleFollows = 0.5;

struct Spine {
  std::vector<NodeId> joints;
  NodeId space;  ///< a control or transform that hips, chest and middle controls hang under
  NodeId hips, chest;
  std::vector<NodeId> middle;
  Plug stretch, volume;  ///< attributes of the chest
};

ControlSpec look(const Builder& b, NodeId joint, const std::string& part, const std::string& role) {
  ControlSpec spec;
  spec.joint = joint;
  spec.role = role;
  face(b, spec, b.with().text("axis"), {});
  spec.frame = oriented(b, joint, "character");
  spec.shape_parameter = part + "_shape";
  spec.shape = b.with().text(spec.shape_parameter);
  spec.size = b.with().number(part + "_size");
  const std::string own_color = part + "_color";
  spec.color = b.with().vec3(b.with().has(own_color) ? own_color : "color");
  return spec;
}

void make_hips(Builder& b, Spine& spine) {
  ControlSpec spec = look(b, spine.joints.front(), "hips", "hips");
  spec.space = spine.space;
  spine.hips = make_control(b, spec).control;
  if (!b.failed()) drive(b, spec, spine.hips);
}

/// Stays where the body is while the hips move, or goes with them.
void make_chest(Builder& b, Spine& spine) {
  ControlSpec spec = look(b, spine.joints.back(), "chest", "chest");
  spec.space = spine.space;
  const ControlNodes made = make_control(b, spec);
  if (b.failed()) return;
  spine.chest = made.control;
  const double follows = b.with().number("follow_hips");
  const NodeId rides =
      ride(b, made.zero, {target(b, spine.space), target(b, spine.hips)}, {1 - follows, follows});
  const Plug with_hips =
      add_number(b, spine.chest, {.name = "follow_hips", .value = follows, .min = 0, .max = 1});
  const Plug without = formula(b, spec.joint, "follow", "1 - $0", {with_hips});
  b.connect(without, {rides, constraint::kWeights, 0});
  b.connect(with_hips, {rides, constraint::kWeights, 1});
  spine.stretch = add_number(
      b, spine.chest, {.name = "stretch", .value = b.with().number("stretch"), .min = 0, .max = 1});
  spine.volume = add_number(
      b, spine.chest, {.name = "volume", .value = b.with().number("volume"), .min = 0, .max = 1});
}

/// Ride between hips and chest, as far from each as they rest.
void make_middle(Builder& b, Spine& spine) {
  const auto count = static_cast<int>(b.with().number("middle"));
  const std::vector<NodeId> inner(spine.joints.begin() + 1, spine.joints.end() - 1);
  for (int i = 1; i <= count && !b.failed(); ++i) {
    const double part = static_cast<double>(i) / (count + 1);
    const math::Vec3 point = point_along(positions(b, spine.joints), part);
    ControlSpec spec = look(b, nearest_joint(b, inner, point), "middle", "ik");
    spec.frame = {character_axes(b), point};
    spec.space = spine.space;
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) return;
    ride(b, made.zero, {target(b, spine.hips), target(b, spine.chest)}, {1 - part, part});
    spine.middle.push_back(made.control);
  }
}

Curve spine_curve(Builder& b, const Spine& spine) {
  CurveSpec spec;
  spec.joint = spine.joints.front();
  spec.controls = {spine.hips};
  spec.controls.insert(spec.controls.end(), spine.middle.begin(), spine.middle.end());
  spec.controls.push_back(spine.chest);
  spec.follows.assign(spec.controls.size(), kMiddleFollows);
  spec.follows.front() = spec.follows.back() = 1;
  for (const NodeId joint : spine.joints) spec.places.push_back(oriented(b, joint, "character"));
  spec.base = spine.space;
  const Curve curve = make_curve(b, spec);
  b.connect(formula(b, spec.joint, "preserve", "1 - $0", {spine.stretch}),
            {curve.node, scene::spline::kPreserve});
  b.set({curve.node, scene::spline::kLeast}, b.with().number("least"));
  b.set({curve.node, scene::spline::kMost}, b.with().number("most"));
  return curve;
}

/// The last joint is turned as the chest control is, also where the spine does not reach that.
void turn_with_chest(Builder& b, const Spine& spine, NodeId zero, const Target& before) {
  const NodeId turn =
      make_constraint(b, scene::Kind::orient_constraint, zero, {target(b, spine.chest)}, {}, true,
                      "space", spine.joints.back());
  b.reconnect(before.world, {turn, constraint::kParent});
  b.reconnect({turn, constraint::kRotation}, {zero, scene::transform::kRotation});
}

/// An FK control for each joint above the hips. Its zero hangs under the control before and lies
/// there as its place on the curve lies in the place before: so turning one takes those above
/// along, on top of what the curve does. The joints follow these controls.
void make_fk(Builder& b, const Spine& spine, const Curve& curve) {
  NodeId below = spine.hips;
  for (std::size_t i = 1; i < spine.joints.size(); ++i) {
    ControlSpec spec = look(b, spine.joints[i], "fk", "fk");
    spec.space = below;
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) return;
    const NodeId rides = ride(b, made.zero, {curve.outputs[i]}, {});
    if (i > 1) b.reconnect(curve.outputs[i - 1].world, {rides, constraint::kParent});
    if (i + 1 == spine.joints.size()) turn_with_chest(b, spine, made.zero, curve.outputs[i - 1]);
    drive(b, spec, made.control);
    below = made.control;
  }
}

/// Joints between hips and chest grow evenly where the spine is short and shrink where it is long;
/// hips and chest, and what hangs on them, keep their size.
void keep_volume(Builder& b, const Spine& spine, const Curve& curve) {
  const NodeId joint = spine.joints.front();
  const Computed grown = compute(b, joint, "volume",
                                 {{"free", curve.stretch},
                                  {"stretch", spine.stretch},
                                  {"volume", spine.volume},
                                  {"least", b.with().number("least")},
                                  {"most", b.with().number("most")}},
                                 "ratio = clamp(1 + (free - 1) * stretch, least, most);"
                                 "size = pow(max(ratio, 0.01), -0.5 * clamp(volume, 0, 1));"
                                 "out larger = vector(size, size, size);"
                                 "out back = vector(1 / size, 1 / size, 1 / size);");
  const std::size_t last = spine.joints.size() - 1;
  for (std::size_t i = 1; i <= last; ++i) {
    const bool inside = i > 1 && b.scene()[spine.joints[i]].parent == spine.joints[i - 1];
    if (i == 1 || (i < last && !inside)) scale_joint(b, spine.joints[i], grown["larger"]);
    if (i == last && inside) scale_joint(b, spine.joints[i], grown["back"]);
  }
}

}  // namespace

void spine_ik(Builder& b) {
  Spine spine;
  spine.joints = b.with().nodes("joints");
  if (spine.joints.size() < 3) {
    b.fail(
        codes::kTooFewJoints, "joints",
        fmt::format("a spine on a curve needs at least three joints, not {}", spine.joints.size()));
    return;
  }
  const NodeId named = space_from(b, "parent", space_of(b, spine.joints.front()));
  if (b.failed() || !check_order(b, spine.joints, "joints")) return;
  spine.space = stand_on(b, named, spine.joints.front());
  make_hips(b, spine);
  if (!b.failed()) make_chest(b, spine);
  if (!b.failed()) make_middle(b, spine);
  if (b.failed()) return;
  const Curve curve = spine_curve(b, spine);
  make_fk(b, spine, curve);
  if (!b.failed()) keep_volume(b, spine, curve);
}

}  // namespace rigc::modules
