// SPDX-License-Identifier: MIT
// Makes the channels of a transfer. Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "bake/transfer_solve.h"

namespace rigc::bake {

struct WriteInput {
  const scene::Scene& scene;
  const std::vector<int>& nodes;
  const std::vector<Aim>& aims;
  const anim::Clip& clip;  ///< as the file has it
  const std::vector<SwitchValue>& switches;
  const TransferPlan& plan;
  const Solution& solution;
  const std::vector<double>& times;  ///< seconds, of the solution's frames
};

/// What the rig drives of joints, and what it has at rest anyway, gets no channel. Fills what the
/// report counts.
Transferred write_channels(const WriteInput& input, TransferReport& report);

/// Controls that had channels in the clip which are replaced or gone after the transfer, by node.
std::vector<scene::NodeId> replaced_controls(const scene::Scene& scene,
                                             const std::vector<int>& nodes, const anim::Clip& clip,
                                             const Transferred& transferred);

/// The clip as it is after the transfer.
anim::Clip changed(const anim::Clip& clip, const Transferred& transferred);

}  // namespace rigc::bake
