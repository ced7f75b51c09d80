// SPDX-License-Identifier: MIT
// Where the rig's nodes stand in their file. Test: tests/gltf/rig_read_test.cpp
#include <algorithm>

#include "gltf/rig.h"
#include "gltf/slim.h"

namespace rigc::gltf {

std::vector<Standing> standings(const Slim& slim, const Rig& rig) {
  std::vector<scene::NodeId> by_node(slim.nodes.size());
  for (const scene::NodeId id : rig.scene.nodes()) {
    const bool has_place = scene::spec(rig.scene[id].kind).is_transform && rig.nodes[id.index] >= 0;
    if (has_place) by_node[static_cast<std::size_t>(rig.nodes[id.index])] = id;
  }
  std::vector<Standing> out(rig.scene.size());
  for (const scene::NodeId id : rig.scene.nodes()) {
    if (rig.nodes[id.index] < 0) continue;
    Standing& standing = out[id.index];
    const SlimNode& node = slim.node(rig.nodes[id.index]);
    standing.local = node.local;
    int at = node.parent;
    while (at >= 0 && at != rig.ancestor && !by_node[static_cast<std::size_t>(at)].valid()) {
      standing.between = slim.node(at).matrix * standing.between;
      at = slim.node(at).parent;
    }
    if (at == rig.ancestor) continue;
    if (at >= 0)
      standing.base = by_node[static_cast<std::size_t>(at)];
    else
      standing.between = math::inverse(slim.world(rig.ancestor)) * standing.between;
  }
  for (std::size_t node = 0; node < slim.nodes.size(); ++node) {
    if (by_node[node].valid()) continue;
    math::Affine way;
    int at = static_cast<int>(node);
    for (; at >= 0 && !by_node[static_cast<std::size_t>(at)].valid(); at = slim.node(at).parent)
      way = slim.node(at).matrix * way;
    if (at >= 0) out[by_node[static_cast<std::size_t>(at)].index].points.push_back(way.origin);
  }
  return out;
}

std::optional<std::vector<Standing>> standings(const File& file, const Rig& rig,
                                               Diagnostics& diagnostics) {
  const auto slim = read_slim(file, diagnostics, false);
  if (!slim) return std::nullopt;
  return standings(*slim, rig);
}

}  // namespace rigc::gltf
