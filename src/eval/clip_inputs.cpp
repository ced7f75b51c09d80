// SPDX-License-Identifier: MIT
// Finds what a clip animates. Test: tests/bake/bake_test.cpp
#include "eval/clip_inputs.h"

#include <map>
#include <optional>

namespace rigc::eval {
namespace {

using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

std::optional<Plug> plug_of(const scene::Scene& scene, NodeId id, const anim::Channel& channel) {
  std::optional<Plug> plug;
  switch (channel.path) {
    case anim::Path::translation:
      return Plug{id, transform::kTranslate};
    case anim::Path::rotation:
      return Plug{id, transform::kRotation};
    case anim::Path::scale:
      return Plug{id, transform::kScale};
    case anim::Path::weights:
      return std::nullopt;
    case anim::Path::attribute:
      break;
  }
  plug = scene.find_plug(id, channel.attribute);
  if (!plug || plug->attribute < scene::kUserAttributes) return std::nullopt;
  if (!scene[id].user[plug->attribute - scene::kUserAttributes].keyable) return std::nullopt;
  return plug;
}

}  // namespace

std::vector<ClipInput> clip_inputs(const scene::Scene& scene, const std::vector<int>& nodes,
                                   const anim::Clip& clip) {
  std::map<int, NodeId> by_node;
  for (const NodeId id : scene.nodes()) {
    const bool moves = scene::spec(scene[id].kind).is_transform && nodes[id.index] >= 0;
    if (moves) by_node.emplace(nodes[id.index], id);
  }
  std::map<Plug, const anim::Curve*> curves;
  for (const anim::Channel& channel : clip.channels) {
    const auto id = by_node.find(channel.node);
    if (id == by_node.end() || !channel.curve.times || channel.curve.times->empty()) continue;
    // What a bake made before is its result, not what it starts from.
    if (channel.baked) continue;
    const auto plug = plug_of(scene, id->second, channel);
    if (plug && channel.curve.width == scene::width(*scene.type(*plug)))
      curves.emplace(*plug, &channel.curve);
  }
  std::vector<ClipInput> inputs;
  for (const auto& [plug, curve] : curves) inputs.push_back({plug, curve});
  return inputs;
}

}  // namespace rigc::eval
