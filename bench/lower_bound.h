// SPDX-License-Identifier: MIT
// The least that evaluating a hierarchy can cost, written by hand: of each transform the unit
// quaternion becomes a matrix and is multiplied with the parent's, for eight frames side by side.
// No program, no scale, nothing checked. Files of their own are compiled for each instruction set
// and have no inline functions to share with others.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rigc::bench {

inline constexpr std::size_t kBoundLanes = 8;

template <class Number>
struct BoundHierarchy {
  std::size_t count;            ///< transforms, parents first
  const std::int32_t* parents;  ///< -1: none
  const Number* translations;   ///< [count][3], the same in all frames
  const Number* rotations;      ///< [count][4][kBoundLanes], x y z w, unit
  Number* worlds;               ///< [count][12][kBoundLanes], columns x, y, z, origin
};

void lower_bound_sse2(const BoundHierarchy<double>& hierarchy);
void lower_bound_sse2(const BoundHierarchy<float>& hierarchy);
void lower_bound_avx2(const BoundHierarchy<double>& hierarchy);
void lower_bound_avx2(const BoundHierarchy<float>& hierarchy);
/// With fused multiplication and addition, which rigc does not use: results would depend on it.
void lower_bound_avx2_fma(const BoundHierarchy<double>& hierarchy);
void lower_bound_avx2_fma(const BoundHierarchy<float>& hierarchy);

}  // namespace rigc::bench
