// SPDX-License-Identifier: MIT
// orient_constraint: the weighted mean of targets, per axis.
// Test: tests/modules/constraints_test.cpp
#include "modules/constraints/weights.h"
#include "modules/registry.h"

namespace rigc::modules {

void orient_constraint(Builder& b) { weighted_constraint(b, scene::Kind::orient_constraint); }

}  // namespace rigc::modules
