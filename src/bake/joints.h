// SPDX-License-Identifier: MIT
// What bake and transfer ask of a scene's joints: what moves them.
// Test: tests/bake/bodies_test.cpp, tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "anim/clip.h"
#include "eval/clip_inputs.h"
#include "scene/scene.h"

namespace rigc::bake {

/// By scene node, whether the clip has a channel on its transform.
std::vector<bool> animated_nodes(const scene::Scene& scene,
                                 const std::vector<eval::ClipInput>& inputs);

/// Whether something is connected into a plug of a transform, whole or in parts; a rotation's Euler
/// view counts.
bool is_driven(const scene::Scene& scene, const scene::Plug& plug);

/// Whether anything is connected into its translation, rotation or scale.
bool is_driven(const scene::Scene& scene, scene::NodeId transform);

/// What a channel of a transform's node moves.
scene::Plug plug_of(scene::NodeId transform, anim::Path path);

}  // namespace rigc::bake
