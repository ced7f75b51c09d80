// SPDX-License-Identifier: MIT
// The time between two frames, and where one looks into it to see whether a frame is missing there.
// Test: tests/bake/insert_test.cpp
#pragma once

#include <cstddef>

#include "bake/rounded.h"

namespace rigc::bake {

struct Gap {
  static constexpr std::size_t kInside = 3;  ///< times at which it is looked at
  static constexpr double kShortest = 1e-3;  ///< seconds; shorter ones mostly are not halved

  double begin, end;  ///< seconds

  /// Evenly spread, at times that a file can hold; i below kInside.
  double inside(std::size_t i) const {
    const double share = static_cast<double>(i + 1) / (kInside + 1);
    return rounded(begin + (end - begin) * share);
  }
  double middle() const { return inside(kInside / 2); }
  /// Whether it can be halved, and is longer than so many seconds.
  bool is_wide(double shortest = kShortest) const {
    return end - begin > shortest && inside(0) > begin && middle() < end;
  }
};

}  // namespace rigc::bake
