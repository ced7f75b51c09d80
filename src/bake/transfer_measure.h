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

/// How far off joints are at the ends of a gap between two keys, and at three times in it.
struct GapOff {
  Deviation at_ends, inside;
  /// How far a joint, or a point at the length of its limb from it, is off in it beyond what it is
  /// at its ends, rig units.
  double excess = 0;
};

void keep_larger(const Deviation& one, Deviation& largest);

/// Indices of all gaps between times: gap i lies between times i and i + 1. One time alone counts
/// as a gap too.
std::vector<std::size_t> all_gaps(const std::vector<double>& times);

/// Evaluates the rig in these gaps, and what they are off by. `times`: rising, seconds. `off`: of
/// all gaps; those of the list are filled.
bool measure(const MeasureInput& input, const std::vector<double>& times,
             const std::vector<std::size_t>& gaps, Threads& threads, std::vector<GapOff>& off,
             Diagnostics& diagnostics);

/// Halves each of these gaps that is off by more than `tolerance`, but those below a millisecond.
/// Gives the new gaps as they are counted when `more`, their middles, are among the times; so is
/// `off` then.
std::vector<std::size_t> split(const std::vector<std::size_t>& gaps, double tolerance,
                               const std::vector<double>& times, std::vector<GapOff>& off,
                               std::vector<double>& more);

}  // namespace rigc::bake
