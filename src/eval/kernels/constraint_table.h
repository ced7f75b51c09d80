// SPDX-License-Identifier: MIT
// The table of the constraint kernel: what rules_constraints.cpp writes, constraint.h and
// direct.cpp read. Test: tests/eval/constraint_test.cpp
#pragma once

#include <cstddef>

namespace rigc::eval::constraint_table {

enum Table : std::size_t {
  kCount,   ///< of targets
  kWay,     ///< one of the three below
  kOffsets  ///< of each target: 12
};

inline constexpr double kGeneral = 0;
inline constexpr double kPoint = 1;  ///< a point constraint: origins alone, offsets beside them
inline constexpr double kEven =
    2;  ///< parent and targets are rotations times factors: more follows

inline constexpr std::size_t offset(std::size_t target) { return kOffsets + 12 * target; }

// Of kEven: what makes the parent's transpose its inverse, then of each target 9 numbers L that
// make transposed(parent) * target * L the rotation, and its scale.
inline constexpr std::size_t smaller(std::size_t count) { return offset(count); }
inline constexpr std::size_t turned(std::size_t count, std::size_t target) {
  return smaller(count) + 1 + 12 * target;
}

}  // namespace rigc::eval::constraint_table
