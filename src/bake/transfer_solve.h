// SPDX-License-Identifier: MIT
// Solves the unknowns of a transfer frame by frame, level by level: with the worlds of their
// parents as the rig evaluates them. Test: tests/bake/transfer_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/transfer_plan.h"
#include "eval/clip_inputs.h"

namespace rigc::bake {

/// [unknowns][frames], rotations continuous.
struct Solution {
  std::vector<std::vector<math::Trs>> locals;  ///< empty for attributes
  std::vector<std::vector<double>> numbers;    ///< of attributes, empty for others
};

struct SolveInput {
  const TransferPlan& plan;
  const std::vector<Aim>& aims;
  const std::vector<std::vector<math::Affine>>& worlds;  ///< of the aims, [aims][frames]
  const std::vector<eval::ClipInput>& clip;              ///< what else the clip moves
  const std::vector<SwitchValue>& switches;
  const std::vector<double>& times;  ///< seconds
  const Solution* others = nullptr;  ///< at other times of the same clip, with which it is merged
};

/// Bones that are lengthened keep their direction. Where a clip moves a joint to the side of its
/// bone, the bone points to it: the joints' places count more than a small turn of the one above.
/// `worlds`: of aims, [aims][frames].
void point_bones(const TransferPlan& plan, std::vector<std::vector<math::Affine>>& worlds);

std::optional<Solution> solve(const scene::Scene& scene, const SolveInput& input, Threads& threads,
                              Diagnostics& diagnostics);

/// Solutions at times that are not the same, as one at all of them.
Solution merged(const scene::Scene& scene, const std::vector<Aim>& aims, const TransferPlan& plan,
                const Solution& a, const std::vector<double>& times_of_a, const Solution& b,
                const std::vector<double>& times_of_b);

}  // namespace rigc::bake
