// SPDX-License-Identifier: MIT
// limb_wrist: in IK the end of a limb turns with its control, or goes with the lower bone.
// Test: tests/modules/limb_wrist_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/limbs/limb_match.h"
#include "modules/registry.h"
#include "modules/steps.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace constraint = scene::constraint;

/// Where the goal would be turned to if it went with the lower bone as at rest, and the IK control
/// turned it from there.
Plug carried_goal(Builder& b, const LimbParts& limb) {
  const math::Affine seen = math::inverse(rest(b, limb.joints[1])) * rest(b, limb.goal);
  const Computed computed = compute(b, limb.joints[2], "wrist",
                                    {{"lower", Plug{limb.solver, scene::ik2::kMiddleWorld}},
                                     {"seen", scene::Value(seen)},
                                     {"turn", Plug{limb.ik, scene::transform::kRotation}}},
                                    "out goal = lower * seen * frame(vector(0, 0, 0), turn);");
  return computed["goal"];
}

}  // namespace

void limb_wrist(Builder& b) {
  const LimbParts limb = limb_from(b, "limb");
  if (b.failed()) return;
  if (b.scene().find_plug(limb.ik, "wrist")) {
    b.fail(codes::kAttributeExists, "limb",
           fmt::format("{} has the attribute \"wrist\" already",
                       traversal::describe(b.scene(), limb.ik)));
    return;
  }
  const Plug wrist = add_number(
      b, limb.ik, {.name = "wrist", .value = b.with().number("wrist"), .min = 0, .max = 1});
  const NodeId turns = limb.blends[2];
  const Plug own =
      formula(b, limb.joints[2], "wrist_own", "$0 * (1 - $1)", {limb.ik_weight, wrist});
  const Plug carried =
      formula(b, limb.joints[2], "wrist_carried", "$0 * $1", {limb.ik_weight, wrist});
  const math::Affine goal = rest(b, limb.goal);
  b.set({turns, constraint::kTargets, 2}, goal);
  b.set({turns, constraint::kWeights, 2}, b.scene().number(wrist));
  b.set({turns, constraint::kOffsets, 2}, math::inverse(goal) * rest(b, limb.joints[2]));
  b.connect(carried_goal(b, limb), {turns, constraint::kTargets, 2});
  b.reconnect(own, {turns, constraint::kWeights, 1});
  b.connect(carried, {turns, constraint::kWeights, 2});
  add_meanings(b, limb.match, {{"wrist", wrist}});
}

}  // namespace rigc::modules
