// SPDX-License-Identifier: MIT
// Kernels that clamp what limits and locks bound. Test: tests/eval/limit_test.cpp
#include "eval/kernels/limit.h"

#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

using math::LimitSpace;

// The table: min, max, axes, origin, rest, order.
constexpr std::size_t kTable = 3 + 3 + 4 + 3 + 4 + 3;

LimitSpace space_from(const double* n) {
  LimitSpace space;
  space.min = {n[0], n[1], n[2]};
  space.max = {n[3], n[4], n[5]};
  space.axes = {n[6], n[7], n[8], n[9]};
  space.origin = {n[10], n[11], n[12]};
  space.rest = {n[13], n[14], n[15], n[16]};
  for (int i = 0; i < 3; ++i) space.order[i] = static_cast<int>(n[17 + i]);
  return space;
}

}  // namespace

std::vector<double> limit_data(const LimitSpace& s) {
  std::vector<double> data;
  data.reserve(kTable);
  for (const math::Vec3& v : {s.min, s.max}) data.insert(data.end(), {v.x, v.y, v.z});
  data.insert(data.end(), {s.axes.x, s.axes.y, s.axes.z, s.axes.w});
  data.insert(data.end(), {s.origin.x, s.origin.y, s.origin.z});
  data.insert(data.end(), {s.rest.x, s.rest.y, s.rest.z, s.rest.w});
  for (const int axis : s.order) data.push_back(axis);
  return data;
}

void limit_vector(const Call& call) {
  const LimitSpace space = space_from(call.data);
  for (int lane = 0; lane < kLanes; ++lane)
    write(call.result(), lane, math::limit_vector(read_vec3(call.in(0), lane), space));
}

void limit_rotation(const Call& call) {
  const LimitSpace space = space_from(call.data);
  for (int lane = 0; lane < kLanes; ++lane)
    write(call.result(), lane, math::limit_rotation(read_quat(call.in(0), lane), space));
}

}  // namespace rigc::eval
