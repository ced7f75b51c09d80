// SPDX-License-Identifier: MIT
// limb_stretch: a limb that reaches for its goal, shortens before it, and has lengths to animate.
// Test: tests/modules/limb_stretch_test.cpp
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/limbs/limb_match.h"
#include "modules/registry.h"
#include "modules/steps.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
namespace ik2 = scene::ik2;

/// No bone is shorter than this part of its true length: one of no length has no direction.
constexpr double kShortest = 0.001;

/// How long the bones are in IK, in true lengths, and how far the end stays behind the goal.
/// Distances are in the space of the limb's base, as the solver counts them, so that the size of
/// the character is no part of them. Soft IK: beyond `hard` the end nears the length of the limb,
/// t, without ever being there. Keys may lie outside an attribute's limits, and count as the limit:
/// a bone of less than no length has two sides to turn to, and rounding would choose between them.
constexpr const char* kReach = R"(
  sizes = scale(base);
  size = abs(sizes.x * sizes.y * sizes.z) ^ (1 / 3);
  root = base * start;
  to_goal = goal * at - root;
  d = length(to_goal) / size;
  upper = length(multiply(middle, start_scale));
  lower = length(multiply(end, multiply(start_scale, middle_scale)));
  long_upper = upper * max(upper_length, shortest);
  long_lower = lower * max(lower_length, shortest);
  shift = 0.9 * clamp(slide, -1, 1) * (slide > 0 ? long_lower : long_upper);
  slid_upper = long_upper + shift;
  slid_lower = long_lower - shift;
  long = slid_upper + slid_lower;
  least = clamp(squash_min, 0.01, 1);
  squashed = 1 + clamp(squash, 0, 1) * (clamp(d / (reach_at_rest * long), least, 1) - 1);
  t = long * squashed;
  zone = t * clamp(soft, 0, 0.5);
  hard = t - zone;
  shown = soft > 0 && d > hard ? hard + zone * (1 - exp((hard - d) / zone)) : min(d, t);
  stretched = 1 + clamp(stretch, 0, 1) * (clamp(d / shown, 1, max(stretch_max, 1)) - 1);
  pinned = clamp(pin, 0, 1);
  upper_now = slid_upper * (squashed * stretched);
  lower_now = slid_lower * (squashed * stretched);
  to_pole = length(pole.origin - root) / size;
  from_pole = length(goal * at - pole.origin) / size;
  out upper_factor = (upper_now + pinned * (to_pole - upper_now)) / upper;
  out lower_factor = (lower_now + pinned * (from_pole - lower_now)) / lower;
  behind = soft > 0 && d > hard ? (1 - pinned) * (shown * stretched / d - 1) : 0;
  out offset = direction(inverse(goal), to_goal * behind);
)";

/// What animators key.
struct Attributes {
  Plug stretch, stretch_max, squash, squash_min, soft, slide, pin;
  std::array<Plug, 2> ik_length, fk_length;  ///< of the upper and the lower bone

  Meanings meanings() const {
    return {{"upper_length", ik_length[0]},
            {"lower_length", ik_length[1]},
            {"fk_upper_length", fk_length[0]},
            {"fk_lower_length", fk_length[1]},
            {"stretch", stretch},
            {"squash", squash},
            {"soft", soft},
            {"slide", slide},
            {"pin", pin}};
  }
};

/// Factors of the true lengths of the upper and the lower bone.
using Factors = std::array<Plug, 2>;

Attributes add_attributes(Builder& b, const LimbParts& limb) {
  const auto number = [&](NodeId control, const char* name, double value, double min,
                          std::optional<double> max) {
    return add_number(b, control, {.name = name, .value = value, .min = min, .max = max});
  };
  const Parameters& with = b.with();
  Attributes a;
  a.stretch = number(limb.ik, "stretch", with.number("stretch"), 0, 1);
  a.stretch_max = number(limb.ik, "stretch_max", with.number("stretch_max"), 1, {});
  a.squash = number(limb.ik, "squash", 0, 0, 1);
  a.squash_min = number(limb.ik, "squash_min", with.number("squash_min"), 0.01, 1);
  a.soft = number(limb.ik, "soft", 0, 0, 0.5);
  a.slide = number(limb.ik, "slide", 0, -1, 1);
  a.ik_length[0] = number(limb.ik, "upper_length", 1, kShortest, {});
  a.ik_length[1] = number(limb.ik, "lower_length", 1, kShortest, {});
  a.pin = number(limb.pole, "pin", 0, 0, 1);
  a.fk_length[0] = number(limb.fk[0], "length", 1, kShortest, {});
  a.fk_length[1] = number(limb.fk[1], "length", 1, kShortest, {});
  return a;
}

/// A limb stretches once.
bool check_new(Builder& b, const LimbParts& limb) {
  if (!b.scene().find_plug(limb.ik, "stretch")) return true;
  b.fail(codes::kAttributeExists, "limb",
         fmt::format("{} has the attribute \"stretch\" already",
                     traversal::describe(b.scene(), limb.ik)),
         "one limb_stretch a limb is enough");
  return false;
}

/// How far the end is from the start, in lengths of the limb.
double reach_at_rest(const Builder& b, const LimbParts& limb) {
  const math::Vec3 p[] = {position(b, limb.joints[0]), position(b, limb.joints[1]),
                          position(b, limb.joints[2])};
  return math::length(p[2] - p[0]) / (math::length(p[1] - p[0]) + math::length(p[2] - p[1]));
}

/// Where the middle and the end are, each seen from the joint before it, at true length.
Given true_place(const Builder& b, std::string name, const Plug& plug) {
  const auto source = b.scene().source(plug);
  return source && b.scene().role(*source) == scene::Role::input
             ? now(b, std::move(name), *source)  // a joint's translate, which may be driven
             : now(b, std::move(name), plug);
}

/// Factors in IK. The end stays behind the goal by a transform under it.
Factors reach(Builder& b, const LimbParts& limb, const Attributes& a) {
  const auto of = [&](std::string name, std::uint16_t attribute) {
    return now(b, std::move(name), {limb.solver, attribute});
  };
  const NodeId goal = b.scene().source({limb.solver, ik2::kGoal})->node;
  const std::vector<Given> given{of("base", ik2::kBase),
                                 of("start", ik2::kStart),
                                 of("goal", ik2::kGoal),
                                 of("pole", ik2::kPole),
                                 {"at", b.scene().value({limb.solver, ik2::kGoalOffset})},
                                 true_place(b, "middle", {limb.solver, ik2::kMiddle}),
                                 true_place(b, "end", {limb.solver, ik2::kEnd}),
                                 of("start_scale", ik2::kStartScale),
                                 of("middle_scale", ik2::kMiddleScale),
                                 {"reach_at_rest", scene::Value(reach_at_rest(b, limb))},
                                 {"shortest", scene::Value(kShortest)},
                                 {"stretch", a.stretch},
                                 {"stretch_max", a.stretch_max},
                                 {"squash", a.squash},
                                 {"squash_min", a.squash_min},
                                 {"soft", a.soft},
                                 {"slide", a.slide},
                                 {"pin", a.pin},
                                 {"upper_length", a.ik_length[0]},
                                 {"lower_length", a.ik_length[1]}};
  const Computed computed = compute(b, limb.joints[2], "reach", given, kReach);
  const NodeId reached = b.make({.kind = scene::Kind::transform,
                                 .role = "driver",
                                 .joint = limb.joints[2],
                                 .parent = goal,
                                 .suffix = "reached"});
  b.connect(computed["offset"], {reached, transform::kTranslate});
  b.reconnect(world_of(reached), {limb.solver, ik2::kGoal});
  return {computed["upper_factor"], computed["lower_factor"]};
}

/// The solver knows the bones as they are in IK.
void tell_solver(Builder& b, const LimbParts& limb, const Factors& ik) {
  const std::uint16_t places[] = {ik2::kMiddle, ik2::kEnd};
  for (std::size_t i = 0; i < 2; ++i) {
    const Plug plug{limb.solver, places[i]};
    const Given place = true_place(b, "place", plug);
    const Computed computed = compute(b, limb.joints[i], "solved_bone", {place, {"factor", ik[i]}},
                                      "out bone = place * factor;");
    b.reconnect(computed["bone"], plug);
  }
}

/// Multiplies what a translate has.
void lengthen(Builder& b, NodeId owner, NodeId node, const Plug& factor) {
  const Plug translate{node, transform::kTranslate};
  const Given place = now(b, "place", translate);
  const Computed computed =
      compute(b, owner, "length", {place, {"factor", factor}}, "out place_now = place * factor;");
  b.reconnect(computed["place_now"], translate);
}

/// The joints from the one before `joint` of the limb down to it, without the first; empty where
/// it hangs elsewhere.
std::vector<NodeId> path_to(const Builder& b, NodeId before, NodeId joint) {
  std::vector<NodeId> path;
  for (NodeId at = joint; at.valid(); at = b.scene()[at].parent) {
    if (at == before) return path;
    path.push_back(at);
  }
  return {};
}

/// A joint that hangs elsewhere follows a place that moves with the joint before it: that moves on.
void lengthen_place(Builder& b, NodeId before, NodeId joint, const Plug& factor) {
  const auto driver = b.scene().source({joint, transform::kTranslate});
  const auto place =
      b.scene().source({driver->node, scene::constraint::kTargets, 0});  // ik_fk_limb made both
  const NodeId zero = b.scene()[place->node].parent;
  const math::Vec3 bone =
      math::inverse(rest(b, zero)).linear * (position(b, joint) - position(b, before));
  const NodeId moved = b.make({.kind = scene::Kind::transform,
                               .role = "space",
                               .joint = joint,
                               .parent = zero,
                               .suffix = "place_length"});
  const Computed computed =
      compute(b, joint, "length", {{"bone", scene::Value(bone)}, {"factor", factor}},
              "out more = bone * (factor - 1);");
  b.connect(computed["more"], {moved, transform::kTranslate});
  b.reparent(place->node, moved);
}

/// Bones get longer by what lies below them: roll joints on the way move along.
void lengthen_bones(Builder& b, const LimbParts& limb, const Factors& factors) {
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeId before = limb.joints[i], joint = limb.joints[i + 1];
    const std::vector<NodeId> path = path_to(b, before, joint);
    for (NodeId rider : path) lengthen(b, joint, rider, factors[i]);
    if (path.empty()) lengthen_place(b, before, joint, factors[i]);
  }
}

}  // namespace

void limb_stretch(Builder& b) {
  const LimbParts limb = limb_from(b, "limb");
  if (b.failed() || !check_new(b, limb)) return;
  const Attributes attributes = add_attributes(b, limb);
  const Factors ik = reach(b, limb, attributes);
  tell_solver(b, limb, ik);
  Factors fk, blended;
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeId below = limb.joints[i + 1];
    fk[i] = formula(b, below, "fk_length", fmt::format("max($0, {})", kShortest),
                    {attributes.fk_length[i]});
    blended[i] = formula(b, below, "length", "$0 + ($1 - $0) * $2", {fk[i], ik[i], limb.ik_weight});
    lengthen(b, below, b.scene()[limb.fk[i + 1]].parent, fk[i]);
  }
  lengthen_bones(b, limb, blended);
  add_meanings(b, limb.match, attributes.meanings());
}

}  // namespace rigc::modules
