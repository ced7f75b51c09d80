// SPDX-License-Identifier: MIT
// auto_pole: the pole of a limb goes where leg and foot go, so that the middle joint never flips.
// Test: tests/modules/auto_pole_test.cpp
#include "modules/layers.h"
#include "modules/limbs/limb.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

using math::Quat;
using math::Vec3;
using scene::Value;
namespace transform = scene::transform;

/// Every field of directions over a sphere has a place where it turns quickly, because a sphere
/// cannot be combed. The shortest turn from the rest direction has it opposite, straight above the
/// hip, where a leg that circles behind the body passes. Here it lies above, inward and behind,
/// through the body, 24 degrees off the planes in which legs swing: the parts of that direction
/// along up, inward and backward.
constexpr double kUp = 2, kInward = 1, kBackward = 1;

/// In the space of what the limb hangs on. Up to 90 degrees from rest the pole turns with the limb
/// the shortest way; from 150 on as from another direction, `centre`, which has its opposite
/// elsewhere. The foot's turn about the limb adds its share, which fades where the foot is turned
/// far away and so has no bound to jump at.
constexpr const char* kProgram = R"(
from_hips = inverse(rotation(base));
reference = slerp(from_hips * rotation(body) * body_rest, none, auto_twist);
down = normalise(inverse(reference) * (inverse(base) * (goal * end) - start));
swing = slerp(between(rest, down), between(centre, down) * to_centre,
              smoothstep(90, 150, acos(dot(down, rest))));
foot_turn = inverse(reference * swing) * (from_hips * rotation(foot) * foot_rest);
follow = sin(twist(foot_turn, rest)) * (1 + dot(foot_turn * rest, rest)) * foot_share;
turn = reference * swing * axis_angle(rest, follow);
seen = inverse(zero) * base * frame(start + turn * to_pole, turn * pole_axes);
out at = seen.origin * auto_pole;
out turned = slerp(none, rotation(seen), auto_pole);
)";

/// Half of what one radian is in degrees: the factor of a sine times a sum that is 2 at most.
constexpr double kHalfRadian = 28.64788975654116;

/// Where the field turns quickly, as a unit vector of rig space.
Vec3 unreached(const Builder& b, NodeId start) {
  const tags::Character& character = b.character();
  return math::normalised(character.up * kUp - character.left * (side_of(b, start) * kInward) -
                          character.forward * kBackward);
}

/// The limb at rest in the space of what it hangs on.
struct Rest {
  math::Affine base;  ///< rig space
  Vec3 direction, centre, to_pole, end;
  Quat axes;  ///< of the base
};

Rest measure(const Builder& b, const LimbParts& limb) {
  Rest at;
  const NodeId parent = b.scene()[limb.joints[0]].parent;
  if (parent.valid()) at.base = rest(b, parent);
  at.axes = math::quaternion(math::orthonormal(at.base.linear));
  const math::Affine inward = math::inverse(at.base);
  const Vec3 start = inward * position(b, limb.joints[0]);
  const Vec3 goal = position(b, limb.joints[2]);
  at.direction = math::normalised(inward * goal - start);
  at.centre = math::normalised(inward.linear * -unreached(b, limb.joints[0]));
  at.to_pole = inward * position(b, limb.pole) - start;
  at.end = math::inverse(rest(b, limb.goal)) * goal;
  return at;
}

/// What takes the rotation of a node, seen from the base, to none at rest.
Quat untwisted(const Builder& b, const Rest& at, NodeId node) {
  const Quat turned = math::quaternion(math::orthonormal(rest(b, node).linear));
  return math::normalised(math::conjugate(turned) * at.axes);
}

}  // namespace

void auto_pole(Builder& b) {
  const Parameters& with = b.with();
  const LimbParts limb = limb_from(b, "limb");
  if (b.failed()) return;
  const NodeId start = limb.joints[0], middle = limb.joints[1];
  const NodeId body = space_from(b, "body", b.scene()[start].parent);
  if (b.failed()) return;
  const NodeId zero = b.scene()[limb.pole].parent;
  const Rest at = measure(b, limb);
  std::vector<Given> given;
  for (const char* name : {"auto_pole", "auto_twist"}) {
    const NumberAttribute attribute{.name = name, .value = with.number(name), .min = 0, .max = 1};
    given.emplace_back(name, add_to(b, limb.ik, attribute, "limb"));
    if (b.failed()) return;
  }
  given.emplace_back("foot_share", Value(with.number("foot") * kHalfRadian));
  given.emplace_back("base", Plug{start, transform::kParent});
  given.emplace_back("start", Plug{start, transform::kTranslate});
  given.emplace_back("goal", limb.goal);
  given.emplace_back("foot", limb.ik);
  given.emplace_back("zero", zero);
  given.emplace_back("body", body.valid() ? world_of(body) : Plug{start, transform::kParent});
  given.emplace_back("none", Value(Quat{}));
  given.emplace_back("rest", Value(at.direction));
  given.emplace_back("centre", Value(at.centre));
  given.emplace_back("to_centre", Value(math::between(at.direction, at.centre)));
  given.emplace_back("to_pole", Value(at.to_pole));
  given.emplace_back("end", Value(at.end));
  given.emplace_back("pole_axes", Value(math::conjugate(untwisted(b, at, limb.pole))));
  given.emplace_back("foot_rest", Value(untwisted(b, at, limb.ik)));
  given.emplace_back("body_rest", Value(body.valid() ? untwisted(b, at, body) : Quat{}));
  const Computed placed = compute(b, middle, "auto_pole", given, kProgram);

  const NodeId moved = make_layer(b, limb.pole, "auto");
  b.connect(placed["at"], {moved, transform::kTranslate});
  b.connect(placed["turned"], {moved, transform::kRotation});
}

}  // namespace rigc::modules
