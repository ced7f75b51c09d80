// SPDX-License-Identifier: MIT
// Steps that solvers share: into a parent's space, weighted means.
// Test: tests/eval/constraint_test.cpp
#pragma once

#include "math/math.h"

namespace rigc::eval {

/// From rig space into the space of `parent`; where the parent is flat, into that of its rotation
/// alone.
math::Affine into(const math::Affine& parent);

/// How far the weights seen so far turn a mean toward the next item: weight / sum, 0 for no weight.
/// Weights below 0 count as 0. Where all are 0 all are equal: `add(1)` each.
class Mean {
 public:
  double add(double weight) {
    sum_ += weight;
    return weight > 0 ? weight / sum_ : 0;
  }

 private:
  double sum_ = 0;
};

}  // namespace rigc::eval
