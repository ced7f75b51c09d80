// SPDX-License-Identifier: MIT
// Takes rigs out of their file. Test: tests/gltf/rig_strip_test.cpp
#include <algorithm>
#include <set>

#include "gltf/rig.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;

/// Which nodes of the file are of rigs, and which of them go.
struct RigNodes {
  std::vector<bool> marked;   ///< carries an identity of a rig that is stripped
  std::vector<bool> goes;
};

/// A node goes when it is ours, of the part that goes, and nothing below it stays: others may have hung things there.
RigNodes find_nodes(const std::vector<json::Value>& nodes, const std::vector<Rig>& rigs) {
  RigNodes out;
  out.marked.assign(nodes.size(), false);
  out.goes.assign(nodes.size(), false);
  for (const Rig& rig : rigs) {
    std::set<int> stays;
    for (const tags::TaggedJoint& joint : rig.skeleton.joints) stays.insert(joint.foreign_node);
    for (const NodeId id : rig.scene.nodes()) {
      const int node = rig.nodes[id.index];
      if (node < 0 || node >= static_cast<int>(nodes.size())) continue;
      out.marked[static_cast<std::size_t>(node)] = true;
      // By what it is, not by the recorded range: other programs order nodes anew.
      const bool ours = !stays.count(node) && rig.scene[id].kind != scene::Kind::mesh;
      out.goes[static_cast<std::size_t>(node)] = ours && !rig.stays(id);
    }
  }
  // Children usually come after their parents, so that one or two passes do.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = nodes.size(); i-- > 0;) {
      if (!out.goes[i]) continue;
      for (const json::Value& child : nodes[i]["children"].items()) {
        if (out.goes[static_cast<std::size_t>(child.integer().value_or(0))]) continue;
        out.goes[i] = false;
        changed = true;
        break;
      }
    }
  }
  return out;
}

/// Elements of `array` that `users` name in `member`, and what they name somewhere deeper.
void collect(const json::Value& value, std::string_view member, std::set<std::int64_t>& out) {
  for (const auto& [name, inner] : value.members()) {
    if (name == member && inner.integer()) out.insert(*inner.integer());
    collect(inner, member, out);
  }
  for (const json::Value& item : value.items()) collect(item, member, out);
}

}  // namespace
}  // namespace rigc::gltf
