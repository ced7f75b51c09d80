// SPDX-License-Identifier: MIT
// What the value of a plug comes from, one step up: the same steps that eval::compile walks.
// Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "scene/scene.h"

namespace rigc::bake {

/// Plugs that a plug is computed from; none where it holds a value of its own.
std::vector<scene::Plug> needs_of(const scene::Scene& scene, const scene::Plug& plug);

}  // namespace rigc::bake
