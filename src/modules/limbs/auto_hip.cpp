// SPDX-License-Identifier: MIT
// auto_hip: legs that are lifted tilt, swing and tuck the hips.
// Test: tests/modules/auto_hip_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/layers.h"
#include "modules/limbs/limb_match.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

using math::Quat;
using math::Vec3;
using scene::Value;
namespace transform = scene::transform;

/// One leg, seen from where the hips control rests, so that nothing that turns the hips is read.
/// How far it is lifted forward and in all are angles that grow to 127 degrees and go back to none
/// where it points straight up, so that no direction has a jump. # stands for the leg's number.
constexpr const char* kLeg = R"(
fk_dir_# = fk_axes_# * fk_# * inverse(fk_axes_#) * rest_#;
ik_dir_# = normalise(inverse(zero) * (goal_# * end_#) - hip_#);
dir_# = normalise(lerp(fk_dir_#, ik_dir_#, ik_#));
below_# = max(1 + dot(dir_#, rest_#), 0.4);
forward_# = 2 * atan(dot(dir_#, ahead_#) / below_#);
lift_# = 2 * atan(length(dir_# - rest_# * dot(dir_#, rest_#)) / below_#);
raised_# = smoothstep(from, to, lift_#);
stepped_# = sign(forward_#) * smoothstep(from, to, abs(forward_#));
)";

/// The side of a lifted leg goes up, that of a leg which is forward goes forward, and the pelvis
/// tucks under legs that are forward.
constexpr const char* kHips = R"(
turn = axis_angle(up, 0 - swing * ({swung}))
     * axis_angle(forward, tilt * ({tilted}))
     * axis_angle(side, 0 - tuck * ({tucked}));
out turned = slerp(none, turn, smoothstep(0, 1, auto_hip));
)";

std::string numbered(std::string text, std::size_t number) {
  for (std::size_t at = 0; (at = text.find('#', at)) != std::string::npos;)
    text.replace(at, 1, std::to_string(number));
  return text;
}

std::string program(std::size_t legs) {
  std::string text, swung = "0", tilted = "0", tucked = "0";
  for (std::size_t i = 0; i < legs; ++i) {
    text += numbered(kLeg, i);
    swung += numbered(" + side_# * stepped_#", i);
    tilted += numbered(" + side_# * raised_#", i);
    tucked += numbered(fmt::format(" + stepped_# / {}", legs), i);
  }
  return text + fmt::format(fmt::runtime(kHips), fmt::arg("swung", swung),
                            fmt::arg("tilted", tilted), fmt::arg("tucked", tucked));
}

/// A leg and what is where it goes in IK.
struct Leg {
  LimbParts limb;
  NodeId goal;
  Vec3 end;  ///< rests in the goal, rig space
};

/// The legs of the parameters; what `feet` names stands for the ends of their bones. Fails where
/// they are not as many.
std::vector<Leg> legs_from(Builder& b) {
  const std::vector<NodeId>& named = b.with().nodes("limbs");
  const std::vector<NodeId>& feet = b.with().nodes("feet");
  std::vector<Leg> legs;
  for (std::size_t i = 0; i < named.size() && !b.failed(); ++i) {
    const LimbParts limb = limb_of(b, named[i], "limbs");
    if (b.failed()) break;
    legs.push_back({limb, limb.goal, position(b, limb.joints[2])});
    if (i < feet.size() && check_place(b, feet[i], "feet"))
      legs.back() = {limb, feet[i], position(b, feet[i])};
  }
  if (!b.failed() && !feet.empty() && feet.size() != named.size())
    b.fail(codes::kFeetCount, "feet",
           fmt::format("{} feet for {} legs", feet.size(), named.size()));
  return legs;
}

/// What the program takes of a leg; directions in the space of the zero, `inward` leads there.
void give_leg(const Builder& b, const Leg& leg, const math::Affine& inward, Vec3 side, Vec3 forward,
              std::size_t number, std::vector<Given>& given) {
  const LimbParts& limb = leg.limb;
  const auto give = [&](const char* name, auto what) {
    given.emplace_back(numbered(name, number), what);
  };
  const Vec3 hip = inward * position(b, limb.joints[0]);
  const Vec3 rest_direction = math::normalised(inward * leg.end - hip);
  const Vec3 ahead = forward - rest_direction * math::dot(forward, rest_direction);
  const math::Mat3 fk = inward.linear * rest(b, limb.fk[0]).linear;
  give("goal_#", leg.goal);
  give("fk_#", Plug{limb.fk[0], transform::kRotation});
  give("ik_#", limb.ik_weight);
  give("fk_axes_#", Value(math::quaternion(math::orthonormal(fk))));
  give("end_#", Value(math::inverse(rest(b, leg.goal)) * leg.end));
  give("hip_#", Value(hip));
  give("rest_#", Value(rest_direction));
  give("ahead_#", Value(math::normalised(ahead, forward)));
  give("side_#", Value(math::dot(hip, side) < 0 ? -1.0 : 1.0));
}

/// The hips control hangs on it, and it on the layer that turns by itself.
void make_tweak(Builder& b, NodeId hips, NodeId layer) {
  const Parameters& with = b.with();
  const NodeId joint = owner(b, hips);
  ControlSpec spec;
  spec.joint = joint;
  spec.role = "tweak";
  spec.suffix = "auto";
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = side_color(b, joint, "color");
  spec.frame = rest(b, layer);
  spec.space = layer;
  spec.translate = false;
  const NodeId tweak = make_control(b, spec).control;
  if (!b.failed()) b.reparent(hips, tweak);
}

}  // namespace

void auto_hip(Builder& b) {
  const Parameters& with = b.with();
  const NodeId hips = with.node("hips");
  const std::vector<Leg> legs = legs_from(b);
  if (b.failed()) return;
  const NodeId zero = zero_of(b, hips);
  const math::Affine inward = math::inverse(rest(b, zero));
  const math::Mat3 axes = math::orthonormal(inward.linear);
  const Vec3 up = axes * b.character().up, forward = axes * b.character().forward;
  const Vec3 side = math::cross(up, forward);
  std::vector<Given> given;
  for (const char* name : {"tilt", "swing", "tuck", "from", "to"})
    given.emplace_back(name, Value(with.number(name)));
  given.emplace_back(
      "auto_hip",
      add_to(b, hips, {.name = "auto_hip", .value = with.number("auto_hip"), .min = 0, .max = 1},
             "hips"));
  if (b.failed()) return;
  given.emplace_back("zero", zero);
  given.emplace_back("up", Value(up));
  given.emplace_back("forward", Value(forward));
  given.emplace_back("side", Value(side));
  given.emplace_back("none", Value(Quat{}));
  for (std::size_t i = 0; i < legs.size(); ++i)
    give_leg(b, legs[i], inward, side, forward, i, given);
  const NodeId layer = make_layer(b, hips, "auto");
  make_tweak(b, hips, layer);
  if (b.failed()) return;
  const Computed turned = compute(b, owner(b, hips), "auto_hip", given, program(legs.size()));
  b.connect(turned["turned"], {layer, transform::kRotation});
  for (const Leg& leg : legs) add_held(b, leg.limb.match, hips);
}

}  // namespace rigc::modules
