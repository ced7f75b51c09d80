// SPDX-License-Identifier: MIT
// Weighted means of transforms: positions and scales are averaged by weight and rotations turned
// toward one after the other by slerp, the nearer way (two targets: slerp by weight).
// Test: tests/eval/worlds_kernels_test.cpp
#pragma once

#include "eval/kernels/lanes.h"

namespace rigc::eval {
namespace {

RIGC_INLINE Trs toward(const Trs& mean, const Trs& placed, Real t) {
  const auto all = t == 1.0, nothing = t == 0.0;
  Trs next{lerp(mean.translation, placed.translation, t),
           generic::slerp(mean.rotation, placed.rotation, t), lerp(mean.scale, placed.scale, t)};
  next.translation = select(all, placed.translation, next.translation);
  next.rotation = select(all, placed.rotation, next.rotation);
  next.scale = select(all, placed.scale, next.scale);
  return {select(nothing, mean.translation, next.translation),
          select(nothing, mean.rotation, next.rotation), select(nothing, mean.scale, next.scale)};
}

/// Of `count` transforms, which placed(i) gives; the weights are arguments `first`, `first` + 2 and
/// so on.
template <class Placed>
RIGC_INLINE Trs weighted_mean(const Lanes& lanes, std::size_t first, std::size_t count,
                              const Placed& placed) {
  Trs mean;
  Mean weights(lanes, first, count);
  for (std::size_t i = 0; i < count; ++i) {
    const Real t = weights.add(i);
    if (!any(t != 0.0)) continue;
    const Trs next = placed(i);
    mean = any(t != 1.0) ? toward(mean, next, t) : next;
  }
  return mean;
}

/// (target, weight)...; data: count, of each target 9 numbers L that make target * L a rotation, t
/// -> the mean of the rotations and of target * t, as a matrix: what a constraint with several
/// targets gives, without its parent's space
struct Blend {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const auto count = static_cast<std::size_t>(lanes.data()[0]);
    const Trs mean = weighted_mean(lanes, 1, count, [&](std::size_t i) {
      const Affine target = lanes.affine(2 * i);
      const Affine own = affine_at(lanes.data() + 1 + 12 * i);
      return Trs{target * own.origin,
                 generic::quaternion(target.linear * own.linear),
                 {Real(1.0), Real(1.0), Real(1.0)}};
    });
    lanes.put(0, generic::compose(mean));
  }
};

}  // namespace
}  // namespace rigc::eval
