// SPDX-License-Identifier: MIT
// Binds the model's skins to joints that a rig made along a bone (scene kind skin_split): what is
// weighted to the bone's joint is shared among them, in accessors of their own.
// Test: tests/gltf/split_weights_test.cpp
#pragma once

#include <set>

#include "gltf/rig.h"

namespace rigc::gltf {

/// Where the rig's settings ask for it, gives each skin that has the joint of such a bone the new
/// joints, and the primitives that are bound to it new weights: see share(). The model's accessors
/// stay, and so does its shape, until the new joints turn. Fills rig.rebound. Skins that have the
/// new joints already are left alone. Warns of what cannot be shared. To be called when rig.nodes
/// are known. Gives the new joints that take a share of some weight.
std::set<scene::NodeId> split_weights(Patch& patch, Rig& rig, Diagnostics& diagnostics);

}  // namespace rigc::gltf
