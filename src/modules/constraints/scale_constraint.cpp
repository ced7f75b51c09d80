// SPDX-License-Identifier: MIT
// scale_constraint: the weighted mean of targets, per axis.
// Test: tests/modules/constraints_test.cpp
#include "modules/constraints/weights.h"
#include "modules/registry.h"

namespace rigc::modules {

void scale_constraint(Builder& b) { weighted_constraint(b, scene::Kind::scale_constraint); }

}  // namespace rigc::modules
