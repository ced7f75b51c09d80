// SPDX-License-Identifier: MIT
// parent_constraint: a node follows others as if it hung under their weighted mean.
// Test: tests/modules/constraints_test.cpp
#include "modules/constraints/weights.h"
#include "modules/registry.h"

namespace rigc::modules {

void parent_constraint(Builder& b) {
  namespace constraint = scene::constraint;
  const NodeId driven = driven_node(b);
  const std::vector<Target> targets = constraint_targets(b);
  const std::vector<double> weights = constraint_weights(b, targets.size());
  if (b.failed()) return;
  const NodeId node = make_constraint(b, scene::Kind::parent_constraint, driven, targets, weights,
                                      b.with().flag("maintain"), "constraint");
  connect_weights(b, node, constraint::kWeights, weights);
  if (b.with().flag("translate")) {
    b.connect({node, constraint::kTranslate}, {driven, scene::transform::kTranslate});
  }
  if (b.with().flag("rotate")) {
    b.connect({node, constraint::kRotation}, {driven, scene::transform::kRotation});
  }
  if (b.with().flag("scale"))
    b.connect({node, constraint::kScale}, {driven, scene::transform::kScale});
}

}  // namespace rigc::modules
