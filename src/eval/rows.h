// SPDX-License-Identifier: MIT
// Values of one lane from the rows of a register. Test: tests/eval/compile_test.cpp
#pragma once

#include "eval/kernels/call.h"
#include "math/math.h"

namespace rigc::eval {

inline math::Vec3 read_vec3(const double* rows, int lane) {
  return {rows[lane], rows[kLanes + lane], rows[2 * kLanes + lane]};
}

inline math::Quat read_quat(const double* rows, int lane) {
  return {rows[lane], rows[kLanes + lane], rows[2 * kLanes + lane], rows[3 * kLanes + lane]};
}

inline math::Affine read_affine(const double* rows, int lane) {
  return {{read_vec3(rows, lane), read_vec3(rows + 3 * kLanes, lane),
           read_vec3(rows + 6 * kLanes, lane)},
          read_vec3(rows + 9 * kLanes, lane)};
}

}  // namespace rigc::eval
