// SPDX-License-Identifier: MIT
// Roll and twist joints of a model: on a bone, and none of the template's.
// Test: tests/modules/twist_joints_test.cpp
#pragma once

#include <vector>

#include "modules/builder.h"

namespace rigc::modules {

struct Rider {
  NodeId joint;
  double fraction = 0;  ///< of the bone: 0 at its start, 1 at its end
};

/// Joints of the model that no joint of the template stands for and that lie on a bone: those
/// between its ends, and those that hang beside the end; by fraction.
std::vector<Rider> riders_on(const Builder& b, NodeId start, NodeId end);

/// Whether a node is another or hangs somewhere below it.
bool lies_above(const Builder& b, NodeId above, NodeId joint);

}  // namespace rigc::modules
