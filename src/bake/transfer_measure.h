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

/// Indices of all gaps between times: gap i lies between times i and i + 1. One time alone counts
/// as a gap too.
std::vector<std::size_t> all_gaps(const std::vector<double>& times);

/// Evaluates the rig at the ends of these gaps and at three times in each; raises the report's
/// deviations. Gives for each how far a joint, or a point at the length of its limb from it, is off
/// in it beyond what it is at its ends, rig units. `times`: rising, seconds.
std::optional<std::vector<double>> measure(const MeasureInput& input,
                                           const std::vector<double>& times,
                                           const std::vector<std::size_t>& gaps, Threads& threads,
                                           TransferReport& report, Diagnostics& diagnostics);

/// Adds a time in the middle of each of these gaps that is off by more than `tolerance`; those
/// below a millisecond stay. Gives the new gaps.
std::vector<std::size_t> split(const std::vector<std::size_t>& gaps, const std::vector<double>& off,
                               double tolerance, std::vector<double>& times);

}  // namespace rigc::bake
