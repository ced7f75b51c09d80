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
    const math::Mat3& m = a->linear;
    return {m.x.x, m.x.y, m.x.z, m.y.x,       m.y.y,       m.y.z,
            m.z.x, m.z.y, m.z.z, a->origin.x, a->origin.y, a->origin.z};
  }
  return {};
}

scene::Value value_from(scene::Type type, const double* n) {
  switch (type) {
    case scene::Type::number:
      return n[0];
    case scene::Type::vec3:
      return math::Vec3{n[0], n[1], n[2]};
    case scene::Type::quat:
      return math::Quat{n[0], n[1], n[2], n[3]};
    default:
      assert(type == scene::Type::matrix);
      return math::Affine{{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}},
                          {n[9], n[10], n[11]}};
  }
}

}  // namespace rigc::eval
