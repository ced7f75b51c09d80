// SPDX-License-Identifier: MIT
// Values as numbers. Test: tests/eval/evaluate_test.cpp
#include "eval/values.h"

#include <cassert>

namespace rigc::eval {

std::vector<double> numbers_of(const scene::Value& value) {
  if (const auto* n = std::get_if<double>(&value)) return {*n};
  if (const auto* v = std::get_if<math::Vec3>(&value)) return {v->x, v->y, v->z};
  if (const auto* q = std::get_if<math::Quat>(&value)) return {q->x, q->y, q->z, q->w};
  if (const auto* a = std::get_if<math::Affine>(&value)) {
    const auto columns = columns_of(*a);
    return {columns.begin(), columns.end()};
  }
  return {};
}

scene::Value value_from(scene::Type type, const double* n) {
  switch (type) {
    case scene::Type::number:
      return n[0];
    case scene::Type::vec3:
      return vec3_from(n);
    case scene::Type::quat:
      return math::Quat{n[0], n[1], n[2], n[3]};
    default:
      assert(type == scene::Type::matrix);
      return affine_from(n);
  }
}

}  // namespace rigc::eval
