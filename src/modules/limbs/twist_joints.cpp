// SPDX-License-Identifier: MIT
// twist_joints: joints along a bone that share out its twist: the model's own, a ribbon's, or new
// ones.
// Test: tests/modules/twist_joints_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "modules/codes.h"
#include "modules/limbs/bone_riders.h"
#include "modules/limbs/share_weights.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace constraint = scene::constraint;
namespace spline = scene::spline;
namespace transform = scene::transform;
using scene::Kind;

/// Where nothing turns there is nothing to do: within this part of the bone.
constexpr double kStill = 0.05;

/// A joint along the bone.
struct Turned : Rider {
  bool is_new = false;
};

struct Bone {
  NodeId start, end;
  math::Vec3 vector;  ///< start to end at rest, rig space
  bool rolls = true;  ///< follows the end's twist; else undoes the start's own
  bool child = true;  ///< the end hangs directly under the start
  std::vector<Turned> riders;
  NodeId ribbon;  ///< curve of a ribbon that has made joints on the bone; invalid: none
};

/// The bone's direction in the space of a joint, at rest.
math::Vec3 axis_in(const Builder& b, const Bone& bone, NodeId joint) {
  const math::Mat3 axes = math::orthonormal(rest(b, joint).linear);
  return math::transposed(axes) * math::normalised(bone.vector);
}

void find_riders(const Builder& b, Bone& bone) {
  bone.child = b.scene()[bone.end].parent == bone.start;
  for (const Rider& rider : riders_on(b, bone.start, bone.end))
    if (bone.rolls ? rider.fraction >= kStill : rider.fraction <= 1 - kStill)
      bone.riders.push_back({rider, false});
}

/// A ribbon's joints on the bone ride on its curve.
void find_ribbon(const Builder& b, Bone& bone) {
  for (const NodeId child : b.scene()[bone.start].children) {
    const auto rides = b.scene().source({child, transform::kTranslate});
    if (b.scene()[child].is_skeleton() || !rides) continue;
    const auto on = b.scene().source({rides->node, constraint::kTargets, 0});
    if (b.scene()[rides->node].kind == Kind::parent_constraint && on &&
        b.scene()[on->node].kind == Kind::spline)
      bone.ribbon = on->node;
  }
}

/// New joints in equal steps, the first at the bone's start where that is to stay, else the last at
/// its end; and what skins need to know to be bound to them.
void make_riders(Builder& b, Bone& bone) {
  const auto count = static_cast<std::size_t>(b.with().number("count"));
  const math::Vec3 end = math::inverse(rest(b, bone.start)) * position(b, bone.end);
  std::vector<double> fractions{bone.rolls ? 0.0 : 1.0};
  for (std::size_t i = 0; i < count; ++i) {
    const double fraction =
        static_cast<double>(bone.rolls ? i + 1 : i) / static_cast<double>(count);
    const NodeId joint = b.make({.kind = Kind::joint,
                                 .role = "twist",
                                 .joint = bone.start,
                                 .parent = bone.start,
                                 .suffix = fmt::format("twist_{}", i + 1)});
    b.set({joint, transform::kTranslate}, end * fraction);
    bone.riders.push_back({{joint, fraction}, true});
    fractions.push_back(fraction);
  }
  std::vector<NodeId> joints;
  for (const Turned& rider : bone.riders) joints.push_back(rider.joint);
  share_weights(b, bone.start, bone.end, joints, fractions);
}

/// The targets of what turns a joint become those of another constraint. False where no constraint
/// turns it.
bool copy_targets(Builder& b, NodeId joint, NodeId to) {
  const auto source = b.scene().source({joint, transform::kRotation});
  if (!source) return false;
  const Kind kind = b.scene()[source->node].kind;
  if (kind != Kind::orient_constraint && kind != Kind::parent_constraint) return false;
  const auto count =
      static_cast<std::int32_t>(b.scene()[source->node].attributes[constraint::kTargets].size());
  for (std::int32_t i = 0; i < count; ++i) {
    for (const std::uint16_t attribute :
         {constraint::kTargets, constraint::kWeights, constraint::kOffsets}) {
      const Plug from{source->node, attribute, i};
      b.set({to, attribute, i}, b.scene().value(from));
      if (const auto plug = b.scene().source(from)) b.connect(*plug, {to, attribute, i});
    }
  }
  return true;
}

/// An end that hangs under riders turns with them: what it is told to turn to says how it will be
/// turned, seen from the start.
Given told_turn(Builder& b, const Bone& bone) {
  const NodeId node = b.make({.kind = Kind::orient_constraint,
                              .role = "driver",
                              .joint = bone.start,
                              .parent = {},
                              .suffix = "turn"});
  follow_world(b, {node, constraint::kParent}, bone.start);
  if (!copy_targets(b, bone.end, node))
    b.fail(codes::kTwistUnknown, "end",
           fmt::format("{} hangs under twist joints of the model, and no constraint turns it",
                       traversal::describe(b.scene(), bone.end)),
           "let a control or limb drive it, in a command before this one");
  return {"turn", Plug{node, constraint::kRotation}};
}

/// How much of the twist animators want; the attribute may be there for another bone already.
Given amount(Builder& b) {
  if (!b.with().has("settings")) return {"amount", 1.0};
  const NodeId control = b.with().node("settings");
  const std::string& name = b.with().text("attribute");
  if (const auto known = b.scene().find_plug(control, name);
      known && known->attribute >= scene::kUserAttributes)
    return {"amount", *known};
  return {"amount", add_number(b, control, {.name = name, .value = 1, .min = 0, .max = 1})};
}

/// The twist that the riders share, in degrees: how far the end is turned about the bone, seen from
/// the start; or the start itself, seen from what it hangs on.
Plug measure_twist(Builder& b, const Bone& bone) {
  const bool under_riders = std::any_of(
      bone.riders.begin(), bone.riders.end(),
      [&](const Turned& rider) { return !rider.is_new && lies_above(b, rider.joint, bone.end); });
  const math::Quat rested = b.scene().local(bone.start).rotation;
  const math::Quat seen = math::quaternion(
      math::orthonormal((math::inverse(rest(b, bone.start)) * rest(b, bone.end)).linear));
  const Given axis{"axis", axis_in(b, bone, bone.start)};
  const Given much = amount(b);
  const auto twist = [&](const std::vector<Given>& given, const std::string& program) {
    std::vector<Given> all{axis, much};
    all.insert(all.end(), given.begin(), given.end());
    return compute(b, bone.start, "twist", all, "out twist = amount * " + program + ";")["twist"];
  };
  if (!bone.rolls)
    return twist({{"turn", Plug{bone.start, transform::kRotation}}, {"rest", rested}},
                 "twist(inverse(rest) * turn, axis)");
  const Given rest{"rest", seen};
  if (under_riders) return twist({told_turn(b, bone), rest}, "twist(turn * inverse(rest), axis)");
  if (bone.child)
    return twist({{"turn", Plug{bone.end, transform::kRotation}}, rest},
                 "twist(turn * inverse(rest), axis)");
  return twist({{"start", bone.start}, {"end", bone.end}, rest},
               "twist(rotation(inverse(start) * end) * inverse(rest), axis)");
}

/// How much of the twist a rider turns by, seen from the start.
double part(const Bone& bone, double fraction) { return bone.rolls ? fraction : fraction - 1; }

/// The same of what a rider hangs under: the start, or another rider.
double part_above(const Builder& b, const Bone& bone, NodeId rider) {
  for (NodeId at = b.scene()[rider].parent; at.valid() && at != bone.start;
       at = b.scene()[at].parent)
    for (const Turned& other : bone.riders)
      if (other.joint == at) return part(bone, other.fraction);
  return 0;
}

void turn(Builder& b, const Bone& bone, const Turned& rider, const Plug& twist) {
  const NodeId above = b.scene()[rider.joint].parent;
  const double share = part(bone, rider.fraction) - part_above(b, bone, rider.joint);
  const Computed computed = compute(b, rider.is_new ? bone.start : rider.joint, "turn",
                                    {{"twist", twist},
                                     {"axis", axis_in(b, bone, above)},
                                     {"share", share},
                                     {"rest", b.scene().local(rider.joint).rotation}},
                                    "out turn = axis_angle(axis, twist * share) * rest;");
  b.connect(computed["turn"], {rider.joint, transform::kRotation});
}

/// Keeps a rider at its fraction of the bone, however long that becomes.
void place(Builder& b, const Bone& bone, const Turned& rider) {
  if (b.scene()[rider.joint].parent != bone.start) return;
  const math::Affine start = math::inverse(rest(b, bone.start));
  std::vector<Given> given{{"rest", b.scene().local(rider.joint).translation},
                           {"fraction", rider.fraction},
                           {"end_rest", start * position(b, bone.end)}};
  std::string end = "end";
  if (bone.child) {
    given.emplace_back("end", Plug{bone.end, transform::kTranslate});
  } else if (!lies_above(b, bone.start, bone.end)) {
    given.emplace_back("start", bone.start);
    given.emplace_back("end", bone.end);
    end = "inverse(start) * end.origin";
  } else {
    return;  // what stretches a bone of several joints moves them
  }
  const Computed computed = compute(b, rider.is_new ? bone.start : rider.joint, "place", given,
                                    "out place = rest + (" + end + " - end_rest) * fraction;");
  b.connect(computed["place"], {rider.joint, transform::kTranslate});
}

/// Twists a ribbon's curve where what it passes through turns with the bone's start. What turns
/// with the end has the end's twist anyway.
void turn_ribbon(Builder& b, const Bone& bone, const Plug& twist) {
  const math::Vec3 origin = position(b, bone.start);
  const double squares = math::dot(bone.vector, bone.vector);
  const auto& controls = b.scene()[bone.ribbon].attributes[spline::kControls];
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(controls.size()); ++i) {
    const NodeId knot = b.scene().source({bone.ribbon, spline::kControls, i})->node;
    const math::Vec3 away = position(b, knot) - origin;
    const double fraction = math::dot(away, bone.vector) / squares;
    const math::Vec3 off = away - bone.vector * fraction;
    if (math::dot(off, off) > 1e-8 * squares || fraction < -1e-4 || fraction > 1 - 1e-4) continue;
    const Plug own{bone.ribbon, spline::kTwists, i};
    const Computed computed =
        compute(b, bone.start, "turn",
                {now(b, "own", own), {"twist", twist}, {"share", part(bone, fraction)}},
                "out turn = own + twist * share;");
    b.reconnect(computed["turn"], own);
  }
}

}  // namespace

void twist_joints(Builder& b) {
  const Parameters& with = b.with();
  Bone bone;
  bone.start = with.node("start");
  bone.end = with.node("end");
  bone.rolls = with.text("mode") == "roll";
  if (!check_order(b, {bone.start, bone.end}, "end")) return;
  bone.vector = position(b, bone.end) - position(b, bone.start);
  if (!(math::length(bone.vector) > 1e-6 * b.character().height)) {
    b.fail(codes::kZeroLengthBone, "end", "start and end lie in one place");
    return;
  }
  find_riders(b, bone);
  find_ribbon(b, bone);
  if (bone.riders.empty() && !bone.ribbon.valid()) make_riders(b, bone);
  const Plug twist = measure_twist(b, bone);
  if (b.failed()) return;
  if (bone.ribbon.valid()) turn_ribbon(b, bone, twist);
  for (const Turned& rider : bone.riders) {
    turn(b, bone, rider, twist);
    place(b, bone, rider);
  }
}

}  // namespace rigc::modules
