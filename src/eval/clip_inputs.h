// SPDX-License-Identifier: MIT
// Which plugs of a scene the channels of a clip move. Test: tests/bake/bake_test.cpp
#pragma once

#include <vector>

#include "anim/clip.h"
#include "scene/scene.h"

namespace rigc::eval {

/// One attribute that a clip animates.
struct ClipInput {
  scene::Plug plug;
  const anim::Curve* curve = nullptr;  ///< of the clip
};

/// Channels of a clip that move plugs of the scene; those on plugs that cannot be animated, and
/// those that a bake made, are left out. `nodes`: glTF node of each scene node, -1: none. Ordered
/// by plug.
std::vector<ClipInput> clip_inputs(const scene::Scene& scene, const std::vector<int>& nodes,
                                   const anim::Clip& clip);

}  // namespace rigc::eval
