// SPDX-License-Identifier: MIT
// Weighted constraints. Each target times its offset is brought into the driven transform's parent
// space and taken apart there; what constrains is their mean. In the parent's space a rest pose
// comes back exactly, also under parents that are mirrored or scaled unevenly.
// Test: tests/eval/constraint_test.cpp
#pragma once

#include "eval/kernels/blend.h"

namespace rigc::eval {
namespace {

/// parent, (target, weight)...; data: count, whether it is a point constraint, offsets
/// -> translation, rotation, scale
struct Constraint {
  enum Argument : std::size_t { kParent, kTargets };

  RIGC_INLINE static void run(const Lanes& lanes) {
    const auto count = static_cast<std::size_t>(lanes.data()[0]);
    const Affine to_parent = into(lanes.affine(kParent));
    const Trs mean = weighted_mean(lanes, kTargets + 1, count,
                                   [&](std::size_t i) { return placed_at(lanes, to_parent, i); });
    lanes.put(0, mean.translation);
    lanes.put(3, mean.rotation);
    lanes.put(7, mean.scale);
  }

 private:
  /// A target in the parent's space: its offset hung under it or, for point constraints, put
  /// beside it.
  RIGC_INLINE static Trs placed_at(const Lanes& lanes, const Affine& to_parent, std::size_t i) {
    const Affine target = lanes.affine(kTargets + 2 * i);
    const Affine offset = affine_at(lanes.data() + 2 + 12 * i);
    if (lanes.data()[1] != 0) return {to_parent * target.origin + offset.origin, {}, {1, 1, 1}};
    return generic::decompose(to_parent * target * offset);
  }
};

}  // namespace
}  // namespace rigc::eval
