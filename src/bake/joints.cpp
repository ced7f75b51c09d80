// SPDX-License-Identifier: MIT
// What bake and transfer ask of a scene's joints.
// Test: tests/bake/bodies_test.cpp, tests/bake/transfer_test.cpp
#include "bake/joints.h"

#include <algorithm>

namespace rigc::bake {

using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

std::vector<bool> animated_nodes(const scene::Scene& scene,
                                 const std::vector<eval::ClipInput>& inputs) {
  std::vector<bool> animated(scene.size(), false);
  for (const eval::ClipInput& input : inputs)
    if (input.plug.attribute < scene::transform::kCount) animated[input.plug.node.index] = true;
  return animated;
}

bool is_driven(const scene::Scene& scene, const Plug& plug) {
  const auto& inputs = scene[plug.node].inputs;
  return std::any_of(inputs.begin(), inputs.end(), [&](const scene::Connection& c) {
    const bool euler =
        plug.attribute == transform::kRotation && c.to.attribute == transform::kRotate;
    return c.to.attribute == plug.attribute || euler;
  });
}

bool is_driven(const scene::Scene& scene, NodeId id) {
  const auto& inputs = scene[id].inputs;
  return std::any_of(inputs.begin(), inputs.end(), [](const scene::Connection& c) {
    return c.to.attribute <= transform::kRotate;
  });
}

Plug plug_of(NodeId id, anim::Path path) {
  return {id, path == anim::Path::translation ? transform::kTranslate
              : path == anim::Path::rotation  ? transform::kRotation
                                              : transform::kScale};
}

}  // namespace rigc::bake
