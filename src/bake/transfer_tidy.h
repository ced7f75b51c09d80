// SPDX-License-Identifier: MIT
// Makes curves of what was solved frame by frame. Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "bake/transfer_plan.h"

namespace rigc::bake {

/// Of a rotation and its negative takes the one nearer to the frame before, and so of turns by 360
/// degrees more or less. What only rounding moves stays, where the scene has it or where it begins:
/// it gets no keys.
class Tidy {
 public:
  Tidy(const scene::Scene& scene, const std::vector<Aim>& aims)
      : scene_(scene), noise_(scene, aims) {}

  /// Values by frame; none for an unknown of the other kind.
  void operator()(const Unknown& u, std::vector<math::Trs>& locals) const;
  void operator()(const Unknown& twist, std::vector<double>& numbers) const;

 private:
  void settle(const Unknown& u, anim::Path path, std::vector<math::Trs>& locals) const;

  const scene::Scene& scene_;
  Noise noise_;
};

}  // namespace rigc::bake
