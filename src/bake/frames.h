// SPDX-License-Identifier: MIT
// The times at which a clip is baked. Test: tests/bake/frames_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/bake.h"

namespace rigc::bake {

/// Seconds, rising, each a 32-bit float, at least one. `clip` gives the range, `animated` (its
/// channels that count) the times where fps is 0. `width`: numbers that the bake keeps for each
/// frame.
std::optional<std::vector<double>> frame_times(const anim::Clip& clip, const anim::Clip& animated,
                                               const Options& options, std::size_t width,
                                               Diagnostics& diagnostics);

/// Whether so many frames fit into the memory that a bake may use; else reported.
bool check_frame_count(double count, std::size_t width, Diagnostics& diagnostics);

}  // namespace rigc::bake
