// SPDX-License-Identifier: MIT
// Numbers as glTF holds them: in 32 bits. What is solved on top of them makes good what that costs.
// Test: tests/bake/match_test.cpp
#pragma once

#include "math/types.h"

namespace rigc::bake {

inline double rounded(double x) { return static_cast<double>(static_cast<float>(x)); }

inline math::Vec3 rounded(math::Vec3 v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

/// Its length is not exactly 1 then.
inline math::Quat rounded(math::Quat q) {
  return {rounded(q.x), rounded(q.y), rounded(q.z), rounded(q.w)};
}

}  // namespace rigc::bake
