// SPDX-License-Identifier: MIT
// vector_foot: a control whose rotation leans the foot over an oval on its sole, to any side.
// Test: tests/modules/vector_foot_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/limbs/limb.h"
#include "modules/limbs/sole.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

using math::Vec3;
using scene::Value;
namespace transform = scene::transform;

/// The control's rotation is a spin about the upright axis and a lean: a direction on the ground
/// and an angle. A share of a lean toward the toes bends the foot over its ball; the rest tilts the
/// sole about the line that touches the oval on that side. How far that line lies from the oval's
/// middle is the oval's support function, in closed form: that of the curve |x / a|^p + |z / c|^p =
/// 1 is (|a x|^q + |c z|^q)^(1 / q), where 1 / p + 1 / q = 1 (Rockafellar, Convex Analysis, section
/// 15). In the first degrees of a lean the line slides out from the middle, so that it never jumps;
/// where it gets steep the foot lifts onto what lies above the line.
constexpr const char* kProgram = R"(
seen = inverse(axes) * control * axes;
spin = axis_angle(up, twist(seen, up));
over = inverse(spin) * seen * up;
lean = normalise(vector(over.x, 0, over.z)) * acos(over.y);
bent = max(lean.z, 0) * ball;
left = lean - ahead * bent;
angle = length(left);
toward = normalise(left);
out_to = pow(pow(abs(toward.x) * half_breadth, power) + pow(abs(toward.z) * half_length, power),
             1 / power);
tilt = axis_angle(cross(up, toward), angle);
pivot = middle + toward * (out_to * angle * angle / (angle * angle + 0.25));
lifted = up * (lift * sin(clamp(angle - edge_tilt, 0, 90)));
out at = spin * (pivot - tilt * pivot) + lifted;
out turned = spin * tilt;
risen = axis_angle(side, bent);
hinge = vector(0, 0, min(hinge_slide * bent, hinge_end));
out over_toes = risen;
out hinged = hinge - risen * hinge;
)";

/// A transform where `node` is, between it and its parent.
NodeId insert_above(Builder& b, NodeId node, const std::string& suffix, NodeId joint,
                    const math::Affine& frame) {
  const math::Affine stays = rest(b, node);
  const NodeId parent = b.scene()[node].parent;
  const NodeId base = b.make({.kind = scene::Kind::transform,
                              .role = "driver",
                              .joint = joint,
                              .parent = {},
                              .suffix = suffix + "_base"});
  hang(b, base, parent, frame);
  const NodeId moved = b.make({.kind = scene::Kind::transform,
                               .role = "driver",
                               .joint = joint,
                               .parent = base,
                               .suffix = suffix});
  hang(b, node, moved, stays);
  return moved;
}

NodeId make_lean_control(Builder& b, const LimbParts& limb, const Sole& sole) {
  const Parameters& with = b.with();
  ControlSpec spec;
  spec.joint = limb.joints[2];
  spec.role = "tweak";
  spec.suffix = "lean";
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = side_color(b, spec.joint, "color");
  const double ahead = sole.tip + with.number("distance");
  spec.frame = {character_axes(b), sole.frame * Vec3{0, 0, ahead}};
  spec.space = limb.ik;
  spec.translate = false;
  return make_control(b, spec).control;
}

bool check_new(Builder& b, const LimbParts& limb) {
  if (Made(b, carrier_below(b, limb.ik, limb)).module() != "vector_foot") return true;
  b.fail(codes::kAttributeExists, "limb",
         fmt::format("{} leans already", traversal::describe(b.scene(), limb.joints[2])),
         "a limb has one vector_foot");
  return false;
}

}  // namespace

void vector_foot(Builder& b) {
  const LimbParts limb = limb_from(b, "limb");
  if (b.failed() || !check_new(b, limb)) return;
  const Sole sole = measure_sole(b, foot_joints(b, limb.joints[2]));
  const NodeId control = make_lean_control(b, limb, sole);
  if (b.failed()) return;
  report_sole(b, control, sole);
  const NodeId joint = limb.joints[2];
  const NodeId top = carrier_below(b, limb.ik, limb);
  const bool rolls = top != limb.goal;
  const math::Quat axes = math::quaternion(math::transposed(character_axes(b)) * sole.frame.linear);
  std::vector<Given> given;
  if (rolls) {
    given.emplace_back(
        "ball", add_number(b, control,
                           {.name = "ball", .value = b.with().number("ball"), .min = 0, .max = 1}));
  } else {
    given.emplace_back("ball", Value(0.0));
  }
  given.emplace_back("control", Plug{control, transform::kRotation});
  given.emplace_back("axes", Value(axes));
  given.emplace_back("side", Value(Vec3{1, 0, 0}));
  given.emplace_back("up", Value(Vec3{0, 1, 0}));
  given.emplace_back("ahead", Value(Vec3{0, 0, 1}));
  given.emplace_back("middle", Value(sole.middle()));
  given.emplace_back("half_breadth", Value((sole.high - sole.low) / 2));
  given.emplace_back("half_length", Value(sole.length() / 2));
  given.emplace_back("power", Value(sole.power));
  given.emplace_back("lift", Value(sole.lift));
  given.emplace_back("edge_tilt", Value(kEdgeTilt));
  given.emplace_back("hinge_slide", Value(sole.hinge_slide));
  given.emplace_back("hinge_end", Value(sole.hinge));
  const Computed leaned = compute(b, joint, "lean", given, kProgram);
  const NodeId tilted = insert_above(b, top, "lean", joint, sole.frame);
  b.connect(leaned["at"], {tilted, transform::kTranslate});
  b.connect(leaned["turned"], {tilted, transform::kRotation});
  if (!rolls) return;
  const math::Affine ball = sole.frame * math::translation({0, sole.ball, 0});
  const NodeId bent = insert_above(b, limb.goal, "bend", joint, ball);
  b.connect(leaned["hinged"], {bent, transform::kTranslate});
  b.connect(leaned["over_toes"], {bent, transform::kRotation});
}

}  // namespace rigc::modules
