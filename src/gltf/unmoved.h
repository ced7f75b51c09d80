// SPDX-License-Identifier: MIT
// Features of a rig that move no vertex of its model: animators would look for what they do.
// Inside of rig.cpp. Test: tests/pipeline/unmoved_test.cpp
#pragma once

#include <set>

#include "gltf/rig.h"

namespace rigc::gltf {

/// glTF nodes that move vertices of a model by themselves.
struct Movers {
  std::set<int> skinned;  ///< joints with a weight in a skin that a mesh uses
  std::set<int> rigid;    ///< nodes with a mesh and no skin
  bool empty() const { return skinned.empty() && rigid.empty(); }
};

/// Those of a file, without the nodes of `gone`: what rigs made to be seen. Skins and weights are
/// read as the patch has them by now.
Movers find_movers(const Patch& patch, const std::set<int>& gone);

/// Warns once for each feature whose commands drive joints in some group and none that moves the
/// model, itself or by a node below it; and for each that was asked for where the model has none of
/// its joints. Commands without a feature are only looked at where joints that they make could
/// share weights. `shared`: joints of commands that do. Nothing is said of models without meshes.
void warn_of_unmoved(const Patch& patch, const Rig& rig, const Movers& movers,
                     const std::set<scene::NodeId>& shared, Diagnostics& diagnostics);

}  // namespace rigc::gltf
