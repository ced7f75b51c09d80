// SPDX-License-Identifier: MIT
// In which order the unknowns of a transfer can be solved. Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "bake/transfer_plan.h"

namespace rigc::bake {

/// Sorts unknowns by level: what the parents of those on one level come from is below it. Gives the
/// number of levels.
int order(const scene::Scene& scene, std::vector<Unknown>& unknowns);

}  // namespace rigc::bake
