// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/transfer.h"
#include "bake/transfer_targets.h"

namespace rigc::bake {

struct MeasureInput {
  const scene::Scene& scene;
  const std::vector<int>& nodes;
  const std::vector<Aim>& aims;  ///< with the curves of the joints' own clip
  const std::vector<Standing>& standings;
  anim::Clip clip;  ///< on controls
};

/// Evaluates the rig at all of these times, which rise, and at three between each two; fills the
/// report's deviations. Gives for each gap how far a joint, or a point at the length of its limb
/// from it, is off in it beyond what it is at the gap's ends, rig units.
std::optional<std::vector<double>> measure(const MeasureInput& input,
                                           const std::vector<double>& times, Threads& threads,
                                           TransferReport& report, Diagnostics& diagnostics);

/// Adds a time in the middle of each gap that is off by more than `tolerance`; those below a
/// millisecond stay. False: none was added.
bool split(const std::vector<double>& gaps, double tolerance, std::vector<double>& times);

}  // namespace rigc::bake
