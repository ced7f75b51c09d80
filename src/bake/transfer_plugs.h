// SPDX-License-Identifier: MIT
// What the value of a plug comes from, one step up: the same steps that eval::compile walks.
// Test: tests/bake/transfer_test.cpp
#pragma once

#include <set>
#include <vector>

#include "scene/scene.h"

namespace rigc::bake {

/// Plugs that a plug is computed from; none where it holds a value of its own.
std::vector<scene::Plug> needs_of(const scene::Scene& scene, const scene::Plug& plug);

/// Keyable attributes of controls that plugs come from.
std::set<scene::Plug> attributes_behind(const scene::Scene& scene,
                                        const std::vector<scene::Plug>& plugs);

}  // namespace rigc::bake
