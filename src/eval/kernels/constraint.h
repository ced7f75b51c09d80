// SPDX-License-Identifier: MIT
// Weighted constraints. Each target times its offset is brought into the driven transform's parent
// space and taken apart there; what constrains is their mean. In the parent's space a rest pose
// comes back exactly, also under parents that are mirrored or scaled unevenly. Where parent and
// targets are rotations times factors that are known there is less to take apart.
// Test: tests/eval/constraint_test.cpp
#pragma once

#include "eval/kernels/blend.h"
#include "eval/kernels/constraint_table.h"

namespace rigc::eval {
namespace {

/// parent, (target, weight)...; data: constraint_table.h -> translation, rotation, scale
struct Constraint {
  enum Argument : std::size_t { kParent, kTargets };

  RIGC_INLINE static void run(const Lanes& lanes) {
    if (lanes.data()[constraint_table::kWay] == constraint_table::kEven) {
      const Affine parent = lanes.affine(kParent);
      put(lanes, [&](std::size_t i) { return seen_from(lanes, parent, i); });
    } else {
      const Affine to_parent = into(lanes.affine(kParent));
      put(lanes, [&](std::size_t i) { return placed_at(lanes, to_parent, i); });
    }
  }

 private:
  template <class Placed>
  RIGC_INLINE static void put(const Lanes& lanes, const Placed& placed) {
    const Trs mean = weighted_mean(lanes, kTargets + 1, count_of(lanes), placed);
    lanes.put(0, mean.translation);
    lanes.put(3, mean.rotation);
    lanes.put(7, mean.scale);
  }

  RIGC_INLINE static std::size_t count_of(const Lanes& lanes) {
    return static_cast<std::size_t>(lanes.data()[constraint_table::kCount]);
  }

  /// A target in the parent's space: its offset hung under it or, for point constraints, put
  /// beside it.
  RIGC_INLINE static Trs placed_at(const Lanes& lanes, const Affine& to_parent, std::size_t i) {
    const double* d = lanes.data();
    const Affine target = lanes.affine(kTargets + 2 * i);
    const Affine offset = affine_at(d + constraint_table::offset(i));
    if (d[constraint_table::kWay] == constraint_table::kPoint)
      return {to_parent * target.origin + offset.origin, {}, {1, 1, 1}};
    return generic::decompose(to_parent * target * offset);
  }

  /// The same where the parent's inverse is its transpose times a factor.
  RIGC_INLINE static Trs seen_from(const Lanes& lanes, const Affine& parent, std::size_t i) {
    const double* d = lanes.data();
    const std::size_t count = count_of(lanes);
    const double* turned = d + constraint_table::turned(count, i);
    const Affine target = lanes.affine(kTargets + 2 * i);
    const Mat3 back = generic::transposed(parent.linear);
    const Vec3 way = target * vec3_at(d + constraint_table::offset(i) + 9) - parent.origin;
    const Mat3 own{vec3_at(turned), vec3_at(turned + 3), vec3_at(turned + 6)};
    return {back * way * Real(d[constraint_table::smaller(count)]),
            generic::quaternion(back * (target.linear * own)), vec3_at(turned + 9)};
  }
};

}  // namespace
}  // namespace rigc::eval
