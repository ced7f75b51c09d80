// SPDX-License-Identifier: MIT
// leg_3: the third bone of an animal's leg, from hock or wrist to the paw, goes with the first as
// on a spring. Test: tests/modules/leg_3_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "modules/codes.h"
#include "modules/layers.h"
#include "modules/limbs/limb.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

using math::Vec3;
using scene::Value;
namespace transform = scene::transform;

/// Knee and hock open and close together, by equal angles, as tendons make them in horses and dogs
/// (the reciprocal apparatus). Then the first and the third bone keep their angle to each other:
/// they are one side of a triangle, the second bone is another, and the line from hip to paw is the
/// third. So the law of cosines says how far the third bone is turned from that line. It is turned
/// seen from what holds the control, so that what lifts and rolls the paw under it adds to that.
constexpr const char* kProgram = R"(
line = inverse(holder) * (zero * paw) - inverse(holder) * (base * start);
reach = length(line);
opening = acos((outer * outer + reach * reach - middle * middle) / (2 * outer * reach));
sprung = between(rest, normalise(line)) * axis_angle(normal, opening - rest_opening);
added = inverse(axes) * slerp(none, sprung, spring) * axis_angle(normal, hock) * axes;
out turned = added;
out at = paw - added * paw;
)";

/// The leg at rest, seen from what holds the control.
struct Triangle {
  Vec3 line;          ///< from hip to paw
  Vec3 normal;        ///< unit: turns the line toward the first and third bone
  double outer = 0;   ///< first and third bone, as one side
  double middle = 0;  ///< second bone
};

Triangle measure(const Builder& b, const LimbParts& limb, NodeId paw, const math::Affine& holder) {
  const math::Affine inward = math::inverse(holder);
  const auto at = [&](NodeId joint) { return inward * position(b, joint); };
  const Vec3 hip = at(limb.joints[0]), knee = at(limb.joints[1]), hock = at(limb.joints[2]);
  Triangle out;
  out.line = at(paw) - hip;
  const Vec3 side = knee - hip + at(paw) - hock;
  out.outer = math::length(side);
  out.middle = math::length(hock - knee);
  const Vec3 direction = math::normalised(out.line);
  const Vec3 of_knee =
      math::normalised(math::cross(direction, knee - hip), math::perpendicular(direction));
  const Vec3 normal = math::cross(direction, side);
  out.normal = math::length(normal) > 1e-6 * out.outer ? math::normalised(normal) : of_knee;
  return out;
}

}  // namespace

void leg_3(Builder& b) {
  const Parameters& with = b.with();
  const LimbParts limb = limb_from(b, "limb");
  if (b.failed()) return;
  const NodeId control = with.has("control") ? with.node("control") : limb.ik;
  const NodeId paw = with.node("paw"), end = limb.joints[2], zero = b.scene()[limb.ik].parent;
  const NodeId holder = b.scene()[control].parent;
  const math::Affine held = rest(b, holder), zeroed = rest(b, zero);
  const Triangle leg = measure(b, limb, paw, held);
  const double smallest = 1e-6 * b.character().height;
  if (std::min({leg.outer, leg.middle, math::length(leg.line)}) < smallest) {
    b.fail(codes::kZeroLengthBone, "paw",
           fmt::format("the leg has a bone of no length, or {} is where it begins",
                       traversal::describe(b.scene(), paw)));
    return;
  }
  const double reach = math::length(leg.line);
  const double opening = math::degrees(math::acos(
      (leg.outer * leg.outer + reach * reach - leg.middle * leg.middle) / (2 * leg.outer * reach)));
  std::vector<Given> given;
  given.emplace_back(
      "spring",
      add_to(b, control, {.name = "spring", .value = with.number("spring"), .min = 0, .max = 1},
             "limb"));
  if (b.failed()) return;
  given.emplace_back(
      "hock", add_to(b, control, {.name = "hock", .flavour = scene::UserAttribute::Flavour::angle},
                     "limb"));
  if (b.failed()) return;
  given.emplace_back("zero", zero);
  given.emplace_back("holder", holder);
  given.emplace_back(
      "axes",
      Value(math::quaternion(math::orthonormal(math::inverse(held.linear) * zeroed.linear))));
  given.emplace_back("base", Plug{limb.joints[0], transform::kParent});
  given.emplace_back("start", Plug{limb.joints[0], transform::kTranslate});
  given.emplace_back("paw", Value(math::inverse(zeroed) * position(b, paw)));
  given.emplace_back("rest", Value(math::normalised(leg.line)));
  given.emplace_back("normal", Value(leg.normal));
  given.emplace_back("outer", Value(leg.outer));
  given.emplace_back("middle", Value(leg.middle));
  given.emplace_back("rest_opening", Value(opening));
  given.emplace_back("none", Value(math::Quat{}));
  const Computed sprung = compute(b, end, "spring", given, kProgram);
  const NodeId moved = make_layer(b, limb.ik, "spring");
  b.connect(sprung["at"], {moved, transform::kTranslate});
  b.connect(sprung["turned"], {moved, transform::kRotation});
}

}  // namespace rigc::modules
