// SPDX-License-Identifier: MIT
// What the value of a plug comes from, one step up: the same steps that eval::compile walks.
// Test: tests/bake/transfer_test.cpp
#pragma once

#include <set>
#include <vector>

#include "anim/clip.h"
#include "scene/scene.h"

namespace rigc::bake {

/// Plugs that a plug is computed from; none where it holds a value of its own.
std::vector<scene::Plug> needs_of(const scene::Scene& scene, const scene::Plug& plug);

/// Keyable attributes of controls that plugs come from.
std::set<scene::Plug> attributes_behind(const scene::Scene& scene,
                                        const std::vector<scene::Plug>& plugs);

/// Whether something is connected into a plug of a transform, whole or in parts; a rotation's Euler
/// view counts.
bool is_driven(const scene::Scene& scene, const scene::Plug& plug);

/// Whether anything is connected into its translation, rotation or scale.
bool is_driven(const scene::Scene& scene, scene::NodeId transform);

/// What a channel of a transform's node moves.
scene::Plug plug_of(scene::NodeId transform, anim::Path path);

}  // namespace rigc::bake
