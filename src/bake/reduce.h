// SPDX-License-Identifier: MIT
// Takes keys away that a player's interpolation gives back within a world-space tolerance.
// Test: tests/bake/reduce_test.cpp
#pragma once

#include <vector>

#include "bake/tracks.h"

namespace rigc::bake {

/// Chooses `keys` of every track so that no joint, and no point at the length of its limb from it,
/// is further than `tolerance` (rig units) from where the tracks with all frames play it. Gives the
/// largest distance, measured by playing both at the frames and at three times between each two;
/// where nothing can be reduced, every frame stays a key.
double reduce(const std::vector<Body>& bodies, const std::vector<Reach>& reach,
              const Motion& motion, const std::vector<float>& times, double tolerance,
              Threads& threads, std::vector<Track>& tracks);

}  // namespace rigc::bake
