// SPDX-License-Identifier: MIT
// Weighted constraints. Each target times its offset is brought into the driven transform's parent
// space and taken apart there; then positions and scales are averaged by weight and rotations
// turned toward one after the other by slerp (two targets: slerp by weight). In the parent's space
// a rest pose comes back exactly, also under parents that are mirrored or scaled unevenly.
// Test: tests/eval/constraint_test.cpp
#pragma once

#include "eval/kernels/lanes.h"

namespace rigc::eval {
namespace {

/// parent, (target, weight)...; data: count, whether it is a point constraint, offsets
/// -> translation, rotation, scale
struct Constraint {
  enum Argument : std::size_t { kParent, kTargets };

  RIGC_INLINE static void run(const Lanes& lanes) {
    const auto count = static_cast<std::size_t>(lanes.data()[0]);
    const Affine to_parent = into(lanes.affine(kParent));
    Trs mean;
    Mean weights(lanes, kTargets + 1, count);
    for (std::size_t i = 0; i < count; ++i) {
      const Real t = weights.add(i);
      const Trs placed = placed_at(lanes, to_parent, i);
      mean = any(t != 1.0) ? toward(mean, placed, t) : placed;
    }
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

  RIGC_INLINE static Trs toward(const Trs& mean, const Trs& placed, Real t) {
    const auto all = t == 1.0, nothing = t == 0.0;
    Trs next{lerp(mean.translation, placed.translation, t),
             generic::slerp(mean.rotation, placed.rotation, t), lerp(mean.scale, placed.scale, t)};
    next.translation = select(all, placed.translation, next.translation);
    next.rotation = select(all, placed.rotation, next.rotation);
    next.scale = select(all, placed.scale, next.scale);
    return {select(nothing, mean.translation, next.translation),
            select(nothing, mean.rotation, next.rotation), select(nothing, mean.scale, next.scale)};
  }
};

}  // namespace
}  // namespace rigc::eval
