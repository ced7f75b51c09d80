// SPDX-License-Identifier: MIT
// Makes curves of what was solved frame by frame. Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "bake/transfer_plan.h"

namespace rigc::bake {

/// Values by frame; of an unknown of the other kind there are none.
class Tidy {
 public:
  Tidy(const scene::Scene& scene, const std::vector<Aim>& aims)
      : scene_(scene), noise_(scene, aims) {}

  /// Of a rotation and its negative takes the one nearer to the frame before, and so of turns by
  /// 360 degrees more or less.
  void make_continuous(const Unknown& u, std::vector<math::Trs>& locals) const;
  void make_continuous(const Unknown& u, std::vector<double>& numbers) const;

  /// What only rounding moves stays, where the scene has it or where it begins: it gets no keys.
  /// `others`: of frames that were settled before; then it stays where those do.
  void settle(const Unknown& u, std::vector<math::Trs>& locals,
              const std::vector<math::Trs>* others) const;
  void settle(const Unknown& u, std::vector<double>& numbers,
              const std::vector<double>* others) const;

 private:
  void settle_path(const Unknown& u, anim::Path path, std::vector<math::Trs>& locals,
                   const std::vector<math::Trs>* others) const;

  const scene::Scene& scene_;
  Noise noise_;
};

}  // namespace rigc::bake
