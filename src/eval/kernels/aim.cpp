// SPDX-License-Identifier: MIT
// The aim constraint: a frame with x at the weighted mean of the targets and y toward up, turned by
// the offset, in the parent's space. Where the target lies on the node itself it aims along the
// parent's x. Test: tests/eval/aim_test.cpp
#include "eval/kernels/space.h"
#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

enum Argument : std::size_t { kParent, kPosition, kUpTarget, kUpVector, kTargets };

math::Vec3 mean_target(const Call& call, std::size_t count, int lane) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = call.in(kTargets + 2 * i + 1)[lane];
    sum += weight > 0 ? weight : 0;
  }
  math::Vec3 mean;
  Mean weights;
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = call.in(kTargets + 2 * i + 1)[lane];
    const double t = weights.add(sum > 0 ? (weight > 0 ? weight : 0) : 1);
    mean = math::lerp(mean, read_affine(call.in(kTargets + 2 * i), lane).origin, t);
  }
  return mean;
}

math::Vec3 up_direction(const Call& call, int mode, math::Vec3 position, int lane) {
  const math::Vec3 up = read_vec3(call.in(kUpVector), lane);
  const math::Affine target = read_affine(call.in(kUpTarget), lane);
  if (mode == 1) return target.origin - position;
  if (mode == 2) return math::orthonormal(target.linear) * up;
  return up;
}

// The frame that aims: x at the targets, y up.
math::Mat3 axes_of(const Call& call, const math::Affine& parent, math::Vec3 position, int lane) {
  const auto count = static_cast<std::size_t>(call.data[0]);
  const int mode = static_cast<int>(call.data[1]);
  const math::Vec3 toward = math::normalised(mean_target(call, count, lane) - position,
                                             math::orthonormal(parent.linear).x);
  return math::frame(toward, up_direction(call, mode, position, lane));
}

}  // namespace

void aim(const Call& call) {
  const math::Quat offset{call.data[2], call.data[3], call.data[4], call.data[5]};
  for (int lane = 0; lane < kLanes; ++lane) {
    const math::Affine parent = read_affine(call.in(kParent), lane);
    const math::Vec3 position = parent * read_vec3(call.in(kPosition), lane);
    const math::Mat3 turned = axes_of(call, parent, position, lane) * math::matrix(offset);
    const math::Mat3 local = math::orthonormal(into(parent).linear * turned);
    write(call.result(), lane, math::quaternion(local));
  }
}

// Where the parent is a rotation times a factor: no way into its space and back.
void aim_world(const Call& call) {
  const double* n = call.data + 2;
  const math::Mat3 linear{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
  for (int lane = 0; lane < kLanes; ++lane) {
    const math::Affine parent = read_affine(call.in(kParent), lane);
    const math::Vec3 position = parent * read_vec3(call.in(kPosition), lane);
    const math::Mat3 axes = axes_of(call, parent, position, lane);
    write(call.result(), lane, math::Affine{axes * linear, position});
  }
}

}  // namespace rigc::eval
