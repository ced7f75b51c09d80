// SPDX-License-Identifier: MIT
// Joints that commands make along a bone take a share of its skin weights.
// Test: tests/modules/twist_joints_test.cpp
#pragma once

#include <string>
#include <vector>

#include "modules/wiring.h"

namespace rigc::modules {

/// Says that skins which have `bone` share its weights with `joints`, up to `end`. `fractions`:
/// where along the bone, 0 to 1, the weights are all of one joint: of `bone` itself, then of each
/// of `joints`. Models are changed only by `build --split-weights`.
void share_weights(Builder& b, NodeId bone, NodeId end, const std::vector<NodeId>& joints,
                   const std::vector<double>& fractions);

/// The same along a line in rig space, of which the joint has no part for itself, and for vertices
/// of a surface alone where it has a name. `fractions`: of the line's length.
void share_weights_on(Builder& b, NodeId joint, const std::string& surface,
                      const std::vector<math::Vec3>& line, const std::vector<NodeId>& joints,
                      std::vector<double> fractions);

}  // namespace rigc::modules
