// SPDX-License-Identifier: MIT
// A baked file as rigc plays it: glTF 2.0, sections 3.7.2.2 (morph targets) and 3.7.3 (skins).
#include "players/puppet_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "gltf/accessor.h"
#include "pipeline/character_helpers.h"

namespace rigc::test {
namespace {

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

math::Vec3 vector_at(const float* v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

std::vector<std::vector<float>> rows(const std::vector<float>& numbers, std::size_t width) {
  std::vector<std::vector<float>> out;
  for (auto n = numbers.begin(); n != numbers.end(); n += static_cast<std::ptrdiff_t>(width))
    out.emplace_back(n, n + static_cast<std::ptrdiff_t>(width));
  return out;
}

}  // namespace

Puppet::Puppet(const std::string& path, const std::string& clip) : path_(path), clip_(clip) {
  Diagnostics diagnostics;
  file_ = gltf::open(path, diagnostics);
  REQUIRE(file_);
  slim_ = gltf::read_slim(*file_, diagnostics);
  REQUIRE(slim_);
  for (const gltf::SlimSkin& skin : slim_->skins) {
    auto& binds = inverse_binds_.emplace_back(skin.joints.size());
    if (skin.matrices < 0) continue;
    const auto n =
        gltf::read_floats(*file_, *slim_, skin.matrices, skin.joints.size(), diagnostics);
    REQUIRE(n);
    for (std::size_t j = 0; j < binds.size(); ++j) {
      const float* m = n->data() + j * 16;
      binds[j] = {{vector_at(m), vector_at(m + 4), vector_at(m + 8)}, vector_at(m + 12)};
    }
  }
  const auto meshes = file_->root()["meshes"].items();
  for (std::size_t node = 0; node < slim_->nodes.size(); ++node) {
    if (slim_->nodes[node].mesh < 0) continue;
    const auto list = meshes[at(slim_->nodes[node].mesh)]["primitives"].items();
    for (std::size_t p = 0; p < list.size(); ++p) {
      ShownPrimitive& out = primitives_.emplace_back();
      out.node = static_cast<int>(node);
      out.primitive = static_cast<int>(p);
      read_primitive(list[p], out);
    }
  }
  read_weights(clip);
}

std::vector<float> Puppet::read(const json::Value& accessor, std::size_t& width) const {
  Diagnostics diagnostics;
  const auto index = *accessor.integer();
  const gltf::SlimAccessor& slim = slim_->accessors[at(index)];
  width = static_cast<std::size_t>(slim.width);
  auto numbers =
      gltf::read_floats(*file_, *slim_, static_cast<int>(index), slim.count, diagnostics);
  REQUIRE_MESSAGE(numbers, render(diagnostics, false));
  return *numbers;
}

std::vector<math::Vec3> Puppet::read_points(const json::Value& accessor) const {
  std::size_t width = 0;
  const std::vector<float> numbers = read(accessor, width);
  std::vector<math::Vec3> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.push_back(vector_at(numbers.data() + i));
  return points;
}

void Puppet::read_primitive(const json::Value& json, ShownPrimitive& out) const {
  const json::Value attributes = json["attributes"];
  out.points = read_points(attributes["POSITION"]);
  for (const json::Value& target : json["targets"].items())
    out.targets.push_back(target["POSITION"] ? read_points(target["POSITION"])
                                             : std::vector<math::Vec3>(out.points.size()));
  out.used.assign(out.points.size(), !json["indices"]);
  std::size_t width = 0;
  if (json["indices"])
    for (const float index : read(json["indices"], width)) out.used[at(std::int64_t(index))] = true;
  if (!attributes["JOINTS_0"]) return;
  out.joints = rows(read(attributes["JOINTS_0"], width), 4);
  out.weights = rows(read(attributes["WEIGHTS_0"], width), 4);
}

void Puppet::read_weights(const std::string& clip) {
  for (const gltf::SlimAnimation& animation : slim_->animations) {
    if (animation.name != clip) continue;
    for (const gltf::SlimChannel& channel : animation.channels) {
      if (channel.path != "weights" || channel.node < 0) continue;
      const gltf::SlimSampler& sampler = animation.samplers[at(channel.sampler)];
      Diagnostics diagnostics;
      const std::uint64_t keys = slim_->accessors[at(sampler.input)].count;
      const std::uint64_t values = slim_->accessors[at(sampler.output)].count;
      const auto times = gltf::read_floats(*file_, *slim_, sampler.input, keys, diagnostics);
      const auto numbers = gltf::read_floats(*file_, *slim_, sampler.output, values, diagnostics);
      REQUIRE((times && numbers));
      anim::Curve curve;
      curve.interpolation = sampler.interpolation;
      const bool cubic = curve.interpolation == anim::Interpolation::cubic;
      curve.width = static_cast<int>(values / keys / (cubic ? 3 : 1));
      curve.times = std::make_shared<const std::vector<float>>(*times);
      curve.values = *numbers;
      weight_curves_.push_back({channel.node, std::move(curve)});
    }
  }
}

std::vector<std::vector<math::Affine>> Puppet::worlds(const std::vector<double>& seconds) const {
  return play(path_, clip_, seconds);
}

std::vector<double> Puppet::weights_of(int node, std::size_t count, double seconds) const {
  std::vector<double> weights(count, 0.0);
  const auto mesh = file_->root()["meshes"].items()[at(slim_->node(node).mesh)];
  const auto own = file_->root()["nodes"].items()[at(node)]["weights"];
  const auto initial = (own ? own : mesh["weights"]).items();
  for (std::size_t i = 0; i < std::min(count, initial.size()); ++i)
    weights[i] = *initial[i].number();
  for (const WeightCurve& one : weight_curves_)
    if (one.node == node) anim::sample(one.curve, false, seconds, weights.data());
  return weights;
}

std::vector<math::Vec3> Puppet::vertices(const ShownPrimitive& primitive,
                                         const std::vector<math::Affine>& worlds,
                                         double seconds) const {
  const std::vector<double> morph = weights_of(primitive.node, primitive.targets.size(), seconds);
  const int skin = slim_->node(primitive.node).skin;
  std::vector<math::Affine> bones;
  if (skin >= 0 && !primitive.joints.empty())
    for (std::size_t j = 0; j < slim_->skins[at(skin)].joints.size(); ++j)
      bones.push_back(worlds[at(slim_->skins[at(skin)].joints[j])] * inverse_binds_[at(skin)][j]);
  std::vector<math::Vec3> out;
  for (std::size_t v = 0; v < primitive.points.size(); ++v) {
    math::Vec3 point = primitive.points[v];
    for (std::size_t t = 0; t < morph.size(); ++t)
      point = point + primitive.targets[t][v] * morph[t];
    if (bones.empty()) {
      out.push_back(worlds[at(primitive.node)] * point);
      continue;
    }
    math::Vec3 skinned;
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto weight = static_cast<double>(primitive.weights[v][i]);
      if (weight == 0) continue;
      const auto joint = static_cast<std::size_t>(primitive.joints[v][i]);
      skinned = skinned + (bones[joint] * point) * weight;
      sum += weight;
    }
    out.push_back(sum > 0 ? skinned * (1 / sum) : worlds[at(primitive.node)] * point);
  }
  return out;
}

}  // namespace rigc::test
