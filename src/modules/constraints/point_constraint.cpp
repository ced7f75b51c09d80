// SPDX-License-Identifier: MIT
// point_constraint: the weighted mean of targets, per axis.
// Test: tests/modules/constraints_test.cpp
#include "modules/constraints/weights.h"
#include "modules/registry.h"

namespace rigc::modules {

void point_constraint(Builder& b) { weighted_constraint(b, scene::Kind::point_constraint); }

}  // namespace rigc::modules
