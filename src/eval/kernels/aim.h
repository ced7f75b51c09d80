// SPDX-License-Identifier: MIT
// The aim constraint: a frame with x at the weighted mean of the targets and y toward up, turned by
// the offset, in the parent's space. Where the target lies on the node itself it aims along the
// parent's x. Test: tests/eval/aim_test.cpp
#pragma once

#include "eval/kernels/lanes.h"

namespace rigc::eval {
namespace {

/// parent, position, up_target, up_vector, (target, weight)...; data: count, mode, offset
/// -> rotation
struct Aim {
  enum Argument : std::size_t { kParent, kPosition, kUpTarget, kUpVector, kTargets };

  RIGC_INLINE static void run(const Lanes& lanes) {
    const double* d = lanes.data();
    const Affine parent = lanes.affine(kParent);
    const Vec3 position = parent * lanes.vec3(kPosition);
    const Vec3 target = mean_target(lanes, static_cast<std::size_t>(d[0]));
    const Vec3 toward =
        generic::normalised(target - position, generic::orthonormal(parent.linear).x);
    const Mat3 axes = generic::frame(toward, up_direction(lanes, static_cast<int>(d[1]), position));
    const Mat3 turned = axes * generic::matrix(quat_at(d + 2));
    lanes.put(0, generic::quaternion(generic::orthonormal(into(parent).linear * turned)));
  }

 private:
  RIGC_INLINE static Vec3 mean_target(const Lanes& lanes, std::size_t count) {
    Vec3 mean;
    Mean weights(lanes, kTargets + 1, count);
    for (std::size_t i = 0; i < count; ++i) {
      const Real t = weights.add(i);
      mean = lerp(mean, lanes.origin(kTargets + 2 * i), t);
    }
    return mean;
  }

  RIGC_INLINE static Vec3 up_direction(const Lanes& lanes, int mode, Vec3 position) {
    const Vec3 up = lanes.vec3(kUpVector);
    if (mode == 1) return lanes.origin(kUpTarget) - position;
    if (mode == 2) return generic::orthonormal(lanes.affine(kUpTarget).linear) * up;
    return up;
  }
};

}  // namespace
}  // namespace rigc::eval
