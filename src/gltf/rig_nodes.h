// SPDX-License-Identifier: MIT
// Which glTF node each scene node becomes, and the text of those that are ours.
// Test: tests/gltf/rig_test.cpp
#pragma once

#include <string>
#include <vector>

#include "gltf/float_text.h"
#include "gltf/rig.h"

namespace rigc::gltf {

/// Where the nodes of a rig go.
struct NodePlan {
  std::vector<int> foreign;  ///< by scene node: glTF node of the model, -1: ours or none
  std::vector<scene::NodeId>
      stays;  ///< ours, in the order they get indices: joints and what carries them
  std::vector<scene::NodeId> goes;  ///< ours: what strip takes away
  std::vector<scene::NodeId>
      parents;  ///< by scene node: transform above it in the scene, invalid: none
  std::vector<std::vector<scene::NodeId>>
      children;            ///< by scene node: ours that hang under it in the file
  std::vector<int> roots;  ///< by scene node: names the tree that it lies in, -1: no transform
};

NodePlan plan_nodes(const Rig& rig, int ancestor);

/// Whether `extras.rigc` of a node is somebody else's value, which stays: then the node does not
/// say which joint it is.
bool has_foreign_mark(const json::Value& node);

/// `{"rigc":"...","ik_fk":1.0}`: who it is, and keyable attributes.
std::string extras_text(const std::string& mark,
                        const std::vector<scene::UserAttribute>& attributes);
std::string extras_text(const Rig& rig, scene::NodeId id);

/// Adds translation, rotation and scale where they are not those of the identity. `exact`: as
/// doubles, because they came from a file and shall read back as they were.
template <class Add>
void write_local(const math::Trs& local, bool exact, Add add) {
  const auto list = [&](const double* numbers, std::size_t count) {
    if (!exact) return float_list(numbers, count);
    json::Writer writer;
    writer.numbers(numbers, count);
    return writer.take();
  };
  if (local.translation != math::Vec3{}) add("translation", list(&local.translation.x, 3));
  if (local.rotation != math::Quat{}) add("rotation", list(&local.rotation.x, 4));
  if (local.scale != math::Vec3{1, 1, 1}) add("scale", list(&local.scale.x, 3));
}

/// A node of ours. `mesh`: -1 for none.
std::string node_text(const Rig& rig, const NodePlan& plan, scene::NodeId id, int mesh);

}  // namespace rigc::gltf
