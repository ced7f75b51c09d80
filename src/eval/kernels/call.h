// SPDX-License-Identifier: MIT
// What a kernel is handed: registers of `kLanes` frames, the arguments' places, a table. Kernels
// have no state and no error path: their input was checked when the program was compiled, and for
// degenerate input (zero scales, zero lengths, opposite rotations) each gives finite numbers.
// Test: tests/eval/numbers_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>

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
};

using Kernel = void (*)(const Call&);

}  // namespace rigc::eval
