// SPDX-License-Identifier: MIT
// Weighted constraints. Each target times its offset is brought into the driven transform's parent
// space and taken apart there; then positions and scales are averaged by weight and rotations
// turned toward one after the other by slerp (two targets: slerp by weight). In the parent's space
// a rest pose comes back exactly, also under parents that are mirrored or scaled unevenly.
// Test: tests/eval/constraint_test.cpp
#include "eval/kernels/space.h"
#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

math::Affine offset_at(const double* data) {
  return {{{data[0], data[1], data[2]}, {data[3], data[4], data[5]}, {data[6], data[7], data[8]}},
          {data[9], data[10], data[11]}};
}

double weight_of(const Call& call, std::uint32_t target, int lane) {
  const double weight = call.in(2 + 2 * target)[lane];
  return weight > 0 ? weight : 0;
}

/// A target in the parent's space: its offset hung under it or, for point constraints, put beside
/// it.
math::Trs placed_at(const Call& call, const math::Affine& to_parent, std::uint32_t i, int lane) {
  const math::Affine target = read_affine(call.in(1 + 2 * i), lane);
  const math::Affine offset = offset_at(call.data + 2 + 12 * i);
  if (call.data[1] != 0) return {to_parent * target.origin + offset.origin, {}, {1, 1, 1}};
  return math::decompose(to_parent * target * offset);
}

math::Trs blend(const Call& call, std::uint32_t count, int lane) {
  const math::Affine to_parent = into(read_affine(call.in(0), lane));
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) sum += weight_of(call, i, lane);
  math::Trs mean;
  Mean weights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double t = weights.add(sum > 0 ? weight_of(call, i, lane) : 1);
    if (t == 0) continue;
    const math::Trs placed = placed_at(call, to_parent, i, lane);
    if (t == 1) {
      mean = placed;
      continue;
    }
    mean.translation = math::lerp(mean.translation, placed.translation, t);
    mean.rotation = math::slerp(mean.rotation, placed.rotation, t);
    mean.scale = math::lerp(mean.scale, placed.scale, t);
  }
  return mean;
}

}  // namespace

void constraint(const Call& call) {
  const auto count = static_cast<std::uint32_t>(call.data[0]);
  for (int lane = 0; lane < kLanes; ++lane) {
    const math::Trs mean = blend(call, count, lane);
    write(call.result(), lane, mean.translation);
    write(call.result() + 3 * kLanes, lane, mean.rotation);
    write(call.result() + 7 * kLanes, lane, mean.scale);
  }
}

}  // namespace rigc::eval
