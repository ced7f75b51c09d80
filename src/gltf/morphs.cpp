// SPDX-License-Identifier: MIT
// Morph targets of a file's meshes. Test: tests/pipeline/morphs_test.cpp
#include "gltf/morphs.h"

#include <fmt/format.h>

#include <algorithm>

#include "gltf/accessor.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

using json::Value;

bool moved_by(const Slim& slim, int node, const std::set<int>& joints) {
  const int skin = slim.node(node).skin;
  const auto is_one = [&](int joint) { return joints.count(joint) != 0; };
  if (skin >= 0) {
    const std::vector<int>& of_skin = slim.skins[static_cast<std::size_t>(skin)].joints;
    return std::any_of(of_skin.begin(), of_skin.end(), is_one);
  }
  for (int at = node; at >= 0; at = slim.node(at).parent)
    if (is_one(at)) return true;
  return false;
}

void take_weights(const Value& value, std::vector<float>& weights) {
  const auto items = value.items();
  for (std::size_t i = 0; i < std::min(items.size(), weights.size()); ++i)
    weights[i] = static_cast<float>(items[i].number().value_or(0));
}

}  // namespace

std::vector<MorphedNode> find_morphed(const File& file, const Slim& slim,
                                      const std::set<int>& joints) {
  std::vector<MorphedNode> out;
  const auto meshes = file.root()["meshes"].items();
  const auto nodes = file.root()["nodes"].items();
  for (std::size_t i = 0; i < slim.nodes.size(); ++i) {
    const int mesh = slim.nodes[i].mesh;
    if (mesh < 0 || !moved_by(slim, static_cast<int>(i), joints)) continue;
    const Value& found = meshes[static_cast<std::size_t>(mesh)];
    const auto primitives = found["primitives"].items();
    const std::size_t count = primitives.empty() ? 0 : primitives[0]["targets"].items().size();
    if (count == 0) continue;
    MorphedNode morphed{static_cast<int>(i), std::vector<std::string>(count),
                        std::vector<float>(count)};
    const auto names = found["extras"]["targetNames"].items();
    for (std::size_t k = 0; k < std::min(count, names.size()); ++k)
      morphed.targets[k] = names[k].string().value_or("");
    take_weights(found["weights"], morphed.weights);
    take_weights(nodes[i]["weights"], morphed.weights);
    out.push_back(std::move(morphed));
  }
  return out;
}

std::optional<anim::Curve> read_weights_curve(const File& file, const Slim& slim, int animation,
                                              int node, std::size_t count,
                                              Diagnostics& diagnostics) {
  if (animation < 0) return anim::Curve{};
  const SlimAnimation& from = slim.animations[static_cast<std::size_t>(animation)];
  const auto channel = std::find_if(
      from.channels.begin(), from.channels.end(),
      [&](const SlimChannel& each) { return each.node == node && each.path == "weights"; });
  if (channel == from.channels.end()) return anim::Curve{};
  const SlimSampler& sampler = from.samplers[static_cast<std::size_t>(channel->sampler)];
  const SlimAccessor& output = slim.accessors[static_cast<std::size_t>(sampler.output)];
  const auto keys = slim.accessors[static_cast<std::size_t>(sampler.input)].count;
  const std::uint64_t each = sampler.interpolation == anim::Interpolation::cubic ? 3 : 1;
  if (output.width != 1 || output.count != keys * each * count) {
    diagnostics.report(
        codes::kSampler,
        Place(file.path, fmt::format("/animations/{}/channels/{}", animation, channel->index)),
        fmt::format("accessor {} does not fit {} keys of {} morph targets", sampler.output, keys,
                    count));
    return std::nullopt;
  }
  auto times = read_times(file, slim, sampler.input, diagnostics);
  auto values = read_floats(file, slim, sampler.output, output.count, diagnostics);
  if (!times || !values) return std::nullopt;
  return anim::Curve{sampler.interpolation, static_cast<int>(count),
                     std::make_shared<const std::vector<float>>(*std::move(times)),
                     *std::move(values)};
}

}  // namespace rigc::gltf
