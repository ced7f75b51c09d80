// SPDX-License-Identifier: MIT
// Two-bone limbs: where they bend, where the pole goes, the solver node.
// Test: tests/modules/ik_test.cpp
#include "modules/limbs/two_bone.h"

#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

using math::Vec3;

constexpr double kBent = 0.0872;  // sine of 5 degrees
/// Deviation in lengths of the limb that is only the rounding of a file's floats: its side says
/// nothing, and any plane leaves the limb unmoved.
constexpr double kExactlyStraight = 3e-6;
/// Cosine between where a nearly straight limb is bent at rest and the side to which it should
/// bend, above which it keeps its own plane.
constexpr double kAgrees = 0.5;

/// How far a limb is bent, in degrees, while it swivels from where it rests to where it shall bend
/// to. It rests bent by less than 5.
constexpr double kSwivels = 6, kSwivelled = 16;

/// Deviations from the line, summed over the joints and in lengths of the chain, below which the
/// chain solver takes it for straight; half of eval's, which sees rounded places.
constexpr double kStraightChain = 5e-7;

/// The swivel of a limb whose goal is so far away, in the space of its base; and what turns the
/// bones back about themselves, so that none of them spins.
constexpr const char* kSwivel = R"(
  away = length(inverse(base) * (goal * at) - start);
  upper = length(multiply(middle, start_scale));
  lower = length(multiply(end, multiply(start_scale, middle_scale)));
  bent = acos(clamp((away * away - upper * upper - lower * lower) / (2 * upper * lower), -1, 1));
  swivels = swivel * (1 - smoothstep(swivels_from, swivelled_at, bent));
  out turn = twist + swivels;
  out back = 0 - swivels;
)";

Vec3 perpendicular_part(Vec3 v, Vec3 unit) { return v - unit * math::dot(v, unit); }

/// Where a straight limb bends to: the parameter's side, made perpendicular to the limb.
Vec3 wanted_bend(const Builder& b, const std::string& bend, Vec3 direction) {
  std::string side = bend;
  if (side == "auto")
    side = std::abs(math::dot(direction, b.character().left)) > 0.7 ? "backward" : "forward";
  const Vec3 flat = perpendicular_part(character_direction(b, side), direction);
  if (math::length(flat) > 0.1) return math::normalised(flat);
  // The limb points where it should bend to: up is the next best side.
  return math::normalised(perpendicular_part(b.character().up, direction),
                          math::perpendicular(direction));
}

}  // namespace

TwoBone measure_two_bone(Builder& b, NodeId start, NodeId middle, NodeId end,
                         const std::string& bend) {
  TwoBone limb{start, middle, end, {}, 0};
  const Vec3 p0 = position(b, start), p1 = position(b, middle), p2 = position(b, end);
  const double upper = math::length(p1 - p0), lower = math::length(p2 - p1);
  limb.length = upper + lower;
  if (std::min(upper, lower) < 1e-6 * b.character().height ||
      math::length(p2 - p0) < 1e-6 * limb.length) {
    b.fail(codes::kZeroLengthBone, {},
           fmt::format("the limb from {} to {} has a bone of no length, or ends where it starts",
                       traversal::describe(b.scene(), start), traversal::describe(b.scene(), end)));
    return limb;
  }
  const Vec3 direction = math::normalised(p2 - p0);
  const Vec3 deviation = perpendicular_part(p1 - p0, direction);
  const double sine = math::length(math::cross(p1 - p0, p2 - p1)) / (upper * lower);
  const Vec3 wanted = wanted_bend(b, bend, direction);
  const double out = math::length(deviation);
  const bool has_side = out > kExactlyStraight * limb.length;
  const bool folded = has_side && math::dot(p1 - p0, p2 - p1) < 0;
  const bool agrees = has_side && math::dot(deviation, wanted) > kAgrees * out;
  const bool keeps = sine >= kBent || folded || agrees;
  limb.bend = keeps ? math::normalised(deviation) : wanted;
  if (!keeps && has_side) {
    const double across = math::dot(math::cross(wanted, deviation), direction);
    limb.swivel = math::degrees(math::atan2(across, math::dot(wanted, deviation)));
  }
  return limb;
}

math::Mat3 hinge_frame(const Builder& b, const TwoBone& limb, Vec3 direction) {
  const math::Mat3 usual = bone_frame(b, limb.middle, direction);
  const Vec3 span = position(b, limb.end) - position(b, limb.start);
  const Vec3 inward = math::cross(math::cross(span, limb.bend), usual.x);
  return math::frame(usual.x, math::dot(usual.y, inward) < 0 ? -inward : inward);
}

Vec3 pole_position(const Builder& b, const TwoBone& limb, double distance) {
  // From the middle joint's foot on the line, so that the pole lies in the limb's plane exactly.
  const Vec3 p0 = position(b, limb.start), p2 = position(b, limb.end);
  const Vec3 direction = math::normalised(p2 - p0);
  const Vec3 p1 = position(b, limb.middle);
  const Vec3 foot = p0 + direction * math::dot(p1 - p0, direction);
  const double out = limb.swivel == 0 ? math::dot(p1 - foot, limb.bend) : math::length(p1 - foot);
  return foot + limb.bend * (out + distance);
}

namespace {

/// Stands in for a pole that nobody named: keeps the bend of the rest pose with what the limb hangs
/// on.
NodeId pole_anchor(Builder& b, const TwoBone& limb) {
  return make_place(b, limb.middle, "pole_anchor", space_of(b, limb.start),
                    {character_axes(b), pole_position(b, limb, limb.length)});
}

/// Where middle and end are, each seen from the joint before it. A joint that hangs right there
/// gives its live place, so that length changes are honoured; beyond roll and twist joints, which
/// ride rigidly, and where the skeleton does not carry it, it is where it rests.
void connect_bones(Builder& b, const TwoBone& limb, NodeId node) {
  namespace ik2 = scene::ik2;
  namespace transform = scene::transform;
  const math::Affine from_start = math::inverse(rest(b, limb.start));
  if (b.scene()[limb.middle].parent == limb.start) {
    b.connect({limb.middle, transform::kTranslate}, {node, ik2::kMiddle});
    b.connect({limb.middle, transform::kScale}, {node, ik2::kMiddleScale});
  } else {
    const math::Trs seen = math::decompose(from_start * rest(b, limb.middle));
    b.set({node, ik2::kMiddle}, seen.translation);
    b.set({node, ik2::kMiddleScale}, seen.scale);
  }
  if (b.scene()[limb.end].parent == limb.middle) {
    b.connect({limb.end, transform::kTranslate}, {node, ik2::kEnd});
  } else {
    b.set({node, ik2::kEnd}, math::inverse(rest(b, limb.middle)) * position(b, limb.end));
  }
}

/// Lets the limb swivel to where it shall bend to as its goal comes nearer.
void swivel(Builder& b, const TwoBone& limb, NodeId node, double twist) {
  namespace ik2 = scene::ik2;
  const auto of = [&](std::string name, std::uint16_t attribute) {
    return now(b, std::move(name), {node, attribute});
  };
  const std::vector<Given> given{of("base", ik2::kBase),
                                 of("start", ik2::kStart),
                                 of("goal", ik2::kGoal),
                                 {"at", b.scene().value({node, ik2::kGoalOffset})},
                                 of("middle", ik2::kMiddle),
                                 of("end", ik2::kEnd),
                                 of("start_scale", ik2::kStartScale),
                                 of("middle_scale", ik2::kMiddleScale),
                                 {"swivel", scene::Value(limb.swivel)},
                                 {"swivels_from", scene::Value(kSwivels)},
                                 {"swivelled_at", scene::Value(kSwivelled)},
                                 {"twist", scene::Value(twist)}};
  const Computed turned = compute(b, limb.start, "swivel", given, kSwivel);
  b.connect(turned["turn"], {node, ik2::kTwist});
  b.connect(turned["back"], {node, ik2::kStartTwist});
  b.connect(turned["back"], {node, ik2::kMiddleTwist});
}

}  // namespace

void add_turn(Builder& b, const Plug& turn, const Plug& degrees) {
  const auto before = b.scene().source(turn);
  if (!before) {
    b.connect(degrees, turn);
    return;
  }
  const NodeId start = b.index().joint(b.scene()[turn.node].identity.owner);
  b.reconnect(formula(b, start, "turn", "$0 + $1", {*before, degrees}), turn);
}

NodeId straight_chain_pole(Builder& b, const std::vector<NodeId>& chain, const std::string& bend) {
  const Vec3 first = position(b, chain.front());
  const Vec3 span = position(b, chain.back()) - first;
  const Vec3 direction = math::normalised(span);
  double deviation = 0;
  for (NodeId joint : chain) {
    deviation += math::length(perpendicular_part(position(b, joint) - first, direction));
  }
  const double length = math::length(span);
  if (chain.size() < 3 || !(deviation <= kStraightChain * length)) return {};
  return pole_anchor(b, {chain.front(), chain[chain.size() / 2], chain.back(),
                         wanted_bend(b, bend, direction), length});
}

NodeId make_two_bone(Builder& b, const TwoBone& limb, NodeId goal, NodeId pole, double twist) {
  namespace ik2 = scene::ik2;
  namespace transform = scene::transform;
  const NodeId node = b.make({.kind = scene::Kind::ik_two_bone,
                              .role = "driver",
                              .joint = limb.start,
                              .parent = {},
                              .suffix = "ik"});
  const Vec3 p0 = position(b, limb.start), p1 = position(b, limb.middle),
             p2 = position(b, limb.end);
  const Vec3 normal = math::normalised(math::cross(p2 - p0, limb.bend));
  b.connect({limb.start, transform::kParent}, {node, ik2::kBase});
  b.connect({limb.start, transform::kTranslate}, {node, ik2::kStart});
  b.connect({limb.start, transform::kScale}, {node, ik2::kStartScale});
  connect_bones(b, limb, node);
  follow_world(b, {node, ik2::kGoal}, goal);
  b.set({node, ik2::kGoalOffset}, math::inverse(rest(b, goal)) * p2);
  b.set({node, ik2::kTwist}, twist);
  if (limb.swivel != 0) swivel(b, limb, node, twist);

  // Bone frames at rest: x along the bone, z along the bend normal, which is turned back about the
  // bone where the limb swivels.
  const math::Quat swivelled =
      math::axis_angle(math::normalised(p2 - p0), math::radians(limb.swivel));
  const Vec3 ends[2][2] = {{p0, p1}, {p1, p2}};
  const NodeId joints[2] = {limb.start, limb.middle};
  for (int i = 0; i < 2; ++i) {
    const Vec3 x = math::normalised(ends[i][1] - ends[i][0]);
    const math::Quat back = math::axis_angle(x, math::radians(-limb.swivel));
    const Vec3 z = math::rotate(back * swivelled, normal);
    const math::Mat3 bone = math::frame(x, math::cross(z, x));
    const math::Mat3 axes = math::orthonormal(rest(b, joints[i]).linear);
    b.set({node, ik2::kOffsets, i}, math::quaternion(math::transposed(bone) * axes));
  }
  const NodeId base = b.scene()[limb.start].parent;
  const math::Mat3 base_axes =
      base.valid() ? math::orthonormal(rest(b, base).linear) : math::Mat3{};
  b.set({node, ik2::kNormal}, math::transposed(base_axes) * normal);
  follow_world(b, {node, ik2::kPole}, pole.valid() ? pole : pole_anchor(b, limb));
  return node;
}

}  // namespace rigc::modules
