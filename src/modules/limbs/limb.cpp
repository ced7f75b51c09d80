// SPDX-License-Identifier: MIT
// The parts of a limb, by what its command made. Test: tests/modules/limb_stretch_test.cpp
#include "modules/limbs/limb.h"

#include <fmt/format.h>

#include "modules/codes.h"

namespace rigc::modules {

LimbParts limb_from(Builder& b, std::string_view parameter) {
  return limb_of(b, b.with().node(parameter), parameter);
}

LimbParts limb_of(Builder& b, NodeId named, std::string_view parameter) {
  const Made made(b, named);
  LimbParts limb;
  if (made.module() != "ik_fk_limb") {
    b.fail(codes::kNoLimb, parameter,
           fmt::format("{} is not part of an IK/FK limb", traversal::describe(b.scene(), named)),
           "name what ik_fk_limb made, such as `arm.wrist/ik_fk_limb.settings`");
    return limb;
  }
  const std::vector<NodeId> fk = made.with_role("fk");
  for (std::size_t i = 0; i < 3; ++i) {
    limb.fk[i] = fk[i];
    limb.joints[i] = owner(b, fk[i]);
    limb.blends[i] = made.first(scene::Kind::orient_constraint, limb.joints[i]);
  }
  limb.ik = made.first("ik");
  limb.pole = made.first("pole");
  limb.settings = made.first("settings");
  limb.goal = made.first(scene::Kind::transform, "driver");
  limb.solver = made.first(scene::Kind::ik_two_bone);
  limb.match = made.first(scene::Kind::match);
  const Plug weights{limb.blends[0], scene::constraint::kWeights, 0};
  limb.fk_weight = *b.scene().source(weights);
  limb.ik_weight = *b.scene().source({weights.node, weights.attribute, 1});
  return limb;
}

NodeId carrier_below(const Builder& b, NodeId control, const LimbParts& limb) {
  NodeId at = limb.goal;
  while (at.valid() && b.scene()[at].parent != control) at = b.scene()[at].parent;
  return at;
}

}  // namespace rigc::modules
