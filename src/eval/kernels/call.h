// SPDX-License-Identifier: MIT
// What a kernel is handed: registers of `kLanes` frames, the arguments' places, a table. Kernels
// have no state and no error path: their input was checked when the program was compiled, and for
// degenerate input (zero scales, zero lengths, opposite rotations) each gives finite numbers.
// Test: tests/eval/numbers_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/math.h"

namespace rigc::eval {

/// Frames that a block evaluates at once.
inline constexpr int kLanes = 8;

/// A place in the register file: `width` rows from row `row`. A matrix has 12 rows: its columns x,
/// y, z, origin.
struct Register {
  std::uint32_t row = 0;
  std::uint32_t width = 0;
};

struct Call {
  double* registers;  ///< [rows][kLanes]
  Register out;       ///< overlaps no argument
  const Register* arguments;
  std::uint32_t argument_count;
  const double* data;  ///< the kernel's own table

  const double* in(std::size_t argument) const {
    return registers + static_cast<std::size_t>(arguments[argument].row) * kLanes;
  }
  double* result() const { return registers + static_cast<std::size_t>(out.row) * kLanes; }
};

using Kernel = void (*)(const Call&);

// One lane of rows as a value, and back.
namespace {

[[maybe_unused]] inline math::Vec3 read_vec3(const double* rows, int lane) {
  return {rows[lane], rows[kLanes + lane], rows[2 * kLanes + lane]};
}

[[maybe_unused]] inline math::Quat read_quat(const double* rows, int lane) {
  return {rows[lane], rows[kLanes + lane], rows[2 * kLanes + lane], rows[3 * kLanes + lane]};
}

[[maybe_unused]] inline math::Affine read_affine(const double* rows, int lane) {
  return {{read_vec3(rows, lane), read_vec3(rows + 3 * kLanes, lane),
           read_vec3(rows + 6 * kLanes, lane)},
          read_vec3(rows + 9 * kLanes, lane)};
}

[[maybe_unused]] inline void write(double* rows, int lane, const math::Vec3& v) {
  rows[lane] = v.x;
  rows[kLanes + lane] = v.y;
  rows[2 * kLanes + lane] = v.z;
}

[[maybe_unused]] inline void write(double* rows, int lane, const math::Quat& q) {
  rows[lane] = q.x;
  rows[kLanes + lane] = q.y;
  rows[2 * kLanes + lane] = q.z;
  rows[3 * kLanes + lane] = q.w;
}

[[maybe_unused]] inline void write(double* rows, int lane, const math::Affine& a) {
  write(rows, lane, a.linear.x);
  write(rows + 3 * kLanes, lane, a.linear.y);
  write(rows + 6 * kLanes, lane, a.linear.z);
  write(rows + 9 * kLanes, lane, a.origin);
}

}  // namespace

}  // namespace rigc::eval
