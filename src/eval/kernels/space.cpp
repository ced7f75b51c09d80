// SPDX-License-Identifier: MIT
// Into the space of a parent, whatever the parent. Test: tests/eval/constraint_test.cpp
#include "eval/kernels/space.h"

namespace rigc::eval {

math::Affine into(const math::Affine& parent) {
  const math::Affine inverse = math::inverse(parent);
  if (inverse.linear.x != math::Vec3{} || inverse.linear.y != math::Vec3{}) return inverse;
  return math::inverse(math::Affine{math::orthonormal(parent.linear), parent.origin});
}

}  // namespace rigc::eval
