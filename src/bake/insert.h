// SPDX-License-Identifier: MIT
// Frames between the keys' own times, where joints would play too far off without them.
// Test: tests/bake/insert_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/motion.h"

namespace rigc::bake {

/// Adds frames in the middle of gaps between `times` until linear keys at the frames play every
/// joint, and points at the length of its limb from it, within `tolerance` (rig units) of where the
/// rig has it, measured at three times in each gap. Gaps below a millisecond stay.
std::optional<std::vector<double>> insert_frames(const Evaluator& evaluator,
                                                 std::vector<double> times, double tolerance,
                                                 Threads& threads, Diagnostics& diagnostics);

}  // namespace rigc::bake
