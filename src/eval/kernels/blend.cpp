// SPDX-License-Identifier: MIT
// The weighted mean of worlds that turn and scale evenly: what a constraint with several targets
// gives, without its parent's space. Rotations are turned toward one after the other by slerp, the
// nearer way. Test: tests/eval/worlds_kernels_test.cpp
#include "eval/kernels/space.h"
#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

double weight_of(const Call& call, std::uint32_t target, int lane) {
  const double weight = call.in(2 * target + 1)[lane];
  return weight > 0 ? weight : 0;
}

// A target's rotation and the place of its offset.
math::Trs placed_at(const Call& call, std::uint32_t i, int lane) {
  const math::Affine target = read_affine(call.in(2 * i), lane);
  const double* n = call.data + 1 + 12 * i;
  const math::Mat3 linear{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
  return {
      target * math::Vec3{n[9], n[10], n[11]}, math::quaternion(target.linear * linear), {1, 1, 1}};
}

math::Affine mean_of(const Call& call, std::uint32_t count, int lane) {
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) sum += weight_of(call, i, lane);
  math::Trs mean;
  Mean weights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double t = weights.add(sum > 0 ? weight_of(call, i, lane) : 1);
    if (t == 0) continue;
    const math::Trs placed = placed_at(call, i, lane);
    if (t == 1) {
      mean = placed;
      continue;
    }
    mean.translation = math::lerp(mean.translation, placed.translation, t);
    mean.rotation = math::slerp(mean.rotation, placed.rotation, t);
  }
  return math::compose(mean);
}

}  // namespace

void blend(const Call& call) {
  const auto count = static_cast<std::uint32_t>(call.data[0]);
  for (int lane = 0; lane < kLanes; ++lane) write(call.result(), lane, mean_of(call, count, lane));
}

}  // namespace rigc::eval
