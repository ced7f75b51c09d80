// SPDX-License-Identifier: MIT
// Values of a scene as the numbers that registers hold, and back.
// Test: tests/eval/evaluate_test.cpp
#pragma once

#include <array>
#include <vector>

#include "scene/scene.h"

namespace rigc::eval {

/// 1, 3, 4 or 12 numbers; a matrix by its columns x, y, z, origin. None for text and data.
std::vector<double> numbers_of(const scene::Value& value);

/// The reverse; `type` is one that is evaluated.
scene::Value value_from(scene::Type type, const double* numbers);

// The same for one type.

inline std::array<double, 9> columns_of(const math::Mat3& m) {
  return {m.x.x, m.x.y, m.x.z, m.y.x, m.y.y, m.y.z, m.z.x, m.z.y, m.z.z};
}
inline std::array<double, 12> columns_of(const math::Affine& a) {
  const math::Mat3& m = a.linear;
  return {m.x.x, m.x.y, m.x.z, m.y.x,      m.y.y,      m.y.z,
          m.z.x, m.z.y, m.z.z, a.origin.x, a.origin.y, a.origin.z};
}
inline math::Vec3 vec3_from(const double* n) { return {n[0], n[1], n[2]}; }
inline math::Mat3 mat3_from(const double* n) {
  return {vec3_from(n), vec3_from(n + 3), vec3_from(n + 6)};
}
inline math::Affine affine_from(const double* n) { return {mat3_from(n), vec3_from(n + 9)}; }

}  // namespace rigc::eval
