// SPDX-License-Identifier: MIT
// Kernels that clamp what limits and locks bound. Test: tests/eval/twins_test.cpp
#pragma once

#include "eval/kernels/lanes.h"
#include "math/generic/limits.h"

namespace rigc::eval {
namespace {

/// The table: min, max, axes, origin, rest, order; made by limit_data().
RIGC_INLINE math::LimitSpace limit_space(const double* n) {
  math::LimitSpace space;
  space.min = {n[0], n[1], n[2]};
  space.max = {n[3], n[4], n[5]};
  space.axes = {n[6], n[7], n[8], n[9]};
  space.origin = {n[10], n[11], n[12]};
  space.rest = {n[13], n[14], n[15], n[16]};
  for (int i = 0; i < 3; ++i) space.order[i] = static_cast<int>(n[17 + i]);
  return space;
}

struct LimitVector {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::limit_vector(lanes.vec3(0), limit_space(lanes.data())));
  }
};

struct LimitRotation {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::limit_rotation(lanes.quat(0), limit_space(lanes.data())));
  }
};

}  // namespace
}  // namespace rigc::eval
