// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/gap_fill.h"
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

/// Evaluates the rig in these gaps, and what they are off by. `times`: rising, seconds. `off`: of
/// all gaps; those of the list are filled.
bool measure(const MeasureInput& input, const std::vector<double>& times,
             const std::vector<std::size_t>& gaps, Threads& threads, std::vector<GapOff>& off,
             Diagnostics& diagnostics);

}  // namespace rigc::bake
