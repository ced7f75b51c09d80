// SPDX-License-Identifier: MIT
// Where nodes hang. Test: tests/scene/hierarchy_test.cpp
#pragma once

#include "scene/scene.h"

namespace rigc::scene {

/// The nearest transform above a node; a parent that is none has no place in space. Invalid where
/// there is none.
NodeId transform_above(const Scene& scene, NodeId node);

/// Whether a node is a joint of the skeleton, or one that a command hung under bones; not a helper
/// among the controls.
bool is_bone(const Scene& scene, NodeId node);

}  // namespace rigc::scene
