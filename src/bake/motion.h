// SPDX-License-Identifier: MIT
// Evaluates a clip on a scene frame by frame: how each body moves in the baked file.
// Test: tests/bake/bake_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/bodies.h"
#include "eval/clip_inputs.h"

namespace rigc::bake {

struct Motion {
  std::vector<double> times;  ///< seconds, [frames]
  std::vector<std::vector<math::Trs>>
      locals;  ///< [bodies][frames], relative to the node's parent in the file
  std::vector<std::vector<math::Affine>>
      worlds;        ///< [bodies][frames], rig space: what the locals add up to
  double shear = 0;  ///< largest error where a local transform cannot be expressed
};

/// Numbers that a Motion holds for each body and frame.
inline constexpr std::size_t kMotionWidth = 22;

std::optional<Motion> evaluate(const scene::Scene& scene, const std::vector<Body>& bodies,
                               const std::vector<eval::ClipInput>& inputs,
                               std::vector<double> times, Diagnostics& diagnostics);

/// World of a body from its local transform and the world of its base (null: the rig's space).
math::Affine world_of(const Body& body, const math::Trs& local, const math::Affine* base);

}  // namespace rigc::bake
