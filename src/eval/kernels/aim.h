// SPDX-License-Identifier: MIT
// The aim constraint: a frame with x at the weighted mean of the targets and y toward up, turned by
// the offset, in the parent's space. Where the target lies on the node itself it aims along the
// parent's x. Test: tests/eval/aim_test.cpp
#pragma once

#include "eval/kernels/lanes.h"

namespace rigc::eval {
namespace {

/// The frame that aims, of the arguments parent, position, up_target, up_vector, (target,
/// weight)... and data: count, mode.
struct Aiming {
  enum Argument : std::size_t { kParent, kPosition, kUpTarget, kUpVector, kTargets };

  Affine parent;
  Vec3 position;  ///< in rig space
  Mat3 axes;      ///< x at the targets, y up

  RIGC_INLINE explicit Aiming(const Lanes& lanes)
      : parent(lanes.affine(kParent)), position(parent * lanes.vec3(kPosition)) {
    const double* d = lanes.data();
    const Vec3 target = mean_target(lanes, static_cast<std::size_t>(d[0]));
    const Vec3 toward =
        generic::normalised(target - position, generic::orthonormal(parent.linear).x);
    axes = generic::frame(toward, up_direction(lanes, static_cast<int>(d[1]), position));
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

/// data: count, mode, offset (a rotation) -> rotation in the parent's space
struct Aim {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Aiming aiming(lanes);
    const Mat3 turned = aiming.axes * generic::matrix(quat_at(lanes.data() + 2));
    lanes.put(0, generic::quaternion(generic::orthonormal(into(aiming.parent).linear * turned)));
  }
};

/// data: count, mode, 9 numbers L -> linear: the frame times L, origin: parent * position. Where
/// the parent is a rotation times a factor: no way into its space and back.
struct AimWorld {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Aiming aiming(lanes);
    const double* d = lanes.data() + 2;
    const Mat3 own{vec3_at(d), vec3_at(d + 3), vec3_at(d + 6)};
    lanes.put(0, Affine{aiming.axes * own, aiming.position});
  }
};

}  // namespace
}  // namespace rigc::eval
