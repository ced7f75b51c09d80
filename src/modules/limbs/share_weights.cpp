// SPDX-License-Identifier: MIT
// The node that says how skins share weights. Test: tests/modules/twist_joints_test.cpp
#include "modules/limbs/share_weights.h"

namespace rigc::modules {

namespace split = scene::skin_split;

namespace {

NodeId make_split(Builder& b, NodeId bone, NodeId end, const std::vector<NodeId>& joints,
                  const std::vector<double>& fractions) {
  const NodeId node = b.make({.kind = scene::Kind::skin_split,
                              .role = "driver",
                              .joint = bone,
                              .parent = {},
                              .suffix = "skin_split"});
  std::vector<NodeId> all{bone, end};
  all.insert(all.end(), joints.begin(), joints.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    follow_world(b, {node, split::kJoints, static_cast<std::int32_t>(i)}, all[i]);
  b.set({node, split::kFractions}, fractions);
  return node;
}

}  // namespace

void share_weights(Builder& b, NodeId bone, NodeId end, const std::vector<NodeId>& joints,
                   const std::vector<double>& fractions) {
  make_split(b, bone, end, joints, fractions);
}

void share_weights_on(Builder& b, NodeId joint, const std::string& surface,
                      const std::vector<math::Vec3>& line, const std::vector<NodeId>& joints,
                      std::vector<double> fractions) {
  fractions.insert(fractions.begin(), -1.0);
  const NodeId node = make_split(b, joint, joints.back(), joints, fractions);
  const math::Affine into_joint = math::inverse(rest(b, joint));
  std::vector<double> numbers;
  for (const math::Vec3& point : line) {
    const math::Vec3 at = into_joint * point;
    numbers.insert(numbers.end(), {at.x, at.y, at.z});
  }
  b.set({node, split::kLine}, numbers);
  b.set({node, split::kSurface}, surface);
}

}  // namespace rigc::modules
