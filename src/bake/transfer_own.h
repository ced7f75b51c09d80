// SPDX-License-Identifier: MIT
// Which transforms of a joint's own a transfer may leave as the rig has them, although the clip
// says a little else: files are full of scales of 0.999999. Test: tests/bake/transfer_test.cpp
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "bake/transfer_targets.h"

namespace rigc::bake {

/// Joints (indices of aims) and paths that stay as the scene has them. However many joints are one
/// above the other, leaving all of them moves none by more than `allowed` (rig units).
std::set<std::pair<int, anim::Path>> negligible(const scene::Scene& scene,
                                                const std::vector<Aim>& aims, double allowed);

/// How tall the joints at rest are, roughly: the diagonal of the box around them, rig units.
double extent(const scene::Scene& scene, const std::vector<Aim>& aims);

}  // namespace rigc::bake
