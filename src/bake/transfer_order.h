// SPDX-License-Identifier: MIT
// In which order the unknowns of a transfer can be solved. Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "bake/transfer_plan.h"

namespace rigc::bake {

/// What a two-bone solver knows of its limb before it solves it, in the order in which Limb of
/// transfer_limb.h takes it.
inline constexpr std::uint16_t kLimbReads[] = {scene::ik2::kBase,       scene::ik2::kStart,
                                               scene::ik2::kMiddle,     scene::ik2::kEnd,
                                               scene::ik2::kStartScale, scene::ik2::kMiddleScale};

/// Sorts unknowns by level: what the parents of those on one level come from, and the limbs that
/// they move, is below it, but for `feedback`, where a parent comes from its own child's values.
/// Gives the number of levels.
int order(const scene::Scene& scene, std::vector<Unknown>& unknowns, bool& feedback);

}  // namespace rigc::bake
