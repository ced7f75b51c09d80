// SPDX-License-Identifier: MIT
// How far a transferred clip is from what the joints played. Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "bake/transfer.h"
#include "bake/transfer_targets.h"

namespace rigc::bake {

struct Measure {
  const scene::Scene& scene;
  const std::vector<int>& nodes;
  const std::vector<Aim>& aims;  ///< with the curves of the joints' own clip
  const std::vector<Standing>& standings;
  anim::Clip clip;      ///< on controls
  int keyed_node = -1;  ///< glTF node of a control that moves in it; -1: none does
};

/// Bakes with a frame at every key and in the middle between two, plays that, and fills the
/// report's deviations.
bool measure_deviation(const Measure& measure, const std::vector<double>& times,
                       TransferReport& report, Diagnostics& diagnostics);

}  // namespace rigc::bake
