// SPDX-License-Identifier: MIT
// A clip that moves every control of a rig, and what the rig does then.
#include "pipeline/wiggle_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "eval/clip_inputs.h"
#include "eval/evaluate.h"
#include "gltf/clips.h"
#include "gltf/slim.h"
#include "pipeline/build.h"
#include "support/skeletons.h"

namespace rigc::test {
namespace {

using scene::NodeId;
namespace transform = scene::transform;

constexpr int kKeys = 9;  // in a second: 0.125 s apart, every second one off the grid of 30 frames

std::shared_ptr<const std::vector<float>> key_times() {
  auto times = std::make_shared<std::vector<float>>();
  for (int i = 0; i < kKeys; ++i) times->push_back(static_cast<float>(i) / (kKeys - 1));
  return times;
}

anim::Channel& add_channel(int node, anim::Path path, int width, anim::Clip& clip) {
  static const auto times = key_times();
  anim::Channel& channel = clip.channels.emplace_back();
  channel.node = node;
  channel.path = path;
  channel.curve.width = width;
  channel.curve.times = times;
  return channel;
}

void turn(int node, Random& random, anim::Clip& clip) {
  const math::Vec3 axis = math::normalised(random.vector(1));
  const double size = random.number(0.1, 0.5), speed = random.number(3, 9);
  anim::Channel& channel = add_channel(node, anim::Path::rotation, 4, clip);
  for (const float t : *channel.curve.times) {
    const math::Quat q = math::axis_angle(axis, size * math::sin(speed * static_cast<double>(t)));
    for (const double n : {q.x, q.y, q.z, q.w})
      channel.curve.values.push_back(static_cast<float>(n));
  }
}

void move(int node, double size, Random& random, anim::Clip& clip) {
  const math::Vec3 way = random.vector(size);
  const double speed = random.number(3, 9);
  anim::Channel& channel = add_channel(node, anim::Path::translation, 3, clip);
  for (const float t : *channel.curve.times)
    for (std::size_t c = 0; c < 3; ++c)
      channel.curve.values.push_back(
          static_cast<float>(way[c] * math::sin(speed * static_cast<double>(t))));
}

void blend(int node, const std::string& attribute, Random& random, anim::Clip& clip) {
  anim::Channel& channel = add_channel(node, anim::Path::attribute, 1, clip);
  channel.attribute = attribute;
  for (int i = 0; i < kKeys; ++i)
    channel.curve.values.push_back(static_cast<float>(random.number(0, 1)));
}

anim::Clip clip_for(const Rigged& rigged, std::uint64_t seed) {
  Random random(seed);
  anim::Clip clip;
  clip.name = "wiggle";
  const double size = 0.02 * rigged.rig->skeleton.character.height;
  for (const NodeId id : rigged.scene().nodes()) {
    const scene::Node& node = rigged.scene()[id];
    if (node.kind != scene::Kind::control || rigged.gltf_node(id) < 0) continue;
    if (node.identity.role == "settings") {
      blend(rigged.gltf_node(id), "ik_fk", random, clip);
      continue;
    }
    turn(rigged.gltf_node(id), random, clip);
    if (random.chance(0.5)) move(rigged.gltf_node(id), size, random, clip);
  }
  return clip;
}

/// The first clip of a file with morph weights, by number; -1: none.
int clip_with_weights(const gltf::File& file) {
  const auto animations = file.root()["animations"].items();
  for (std::size_t i = 0; i < animations.size(); ++i)
    for (const json::Value& channel : animations[i]["channels"].items())
      if (channel["target"]["path"].string() == "weights") return static_cast<int>(i);
  return -1;
}

}  // namespace

Wiggle wiggle(Rigged rigged, const std::string& name, std::uint64_t seed) {
  Diagnostics diagnostics;
  const auto file = gltf::open(rigged.path, diagnostics);
  REQUIRE(file);
  anim::Clip clip = clip_for(rigged, seed);
  clip.source_animation = clip_with_weights(*file);
  if (clip.source_animation >= 0) {
    const auto animations = file->root()["animations"].items();
    clip.name = *animations[static_cast<std::size_t>(clip.source_animation)]["name"].string();
  }
  gltf::Patch patch(*file);
  gltf::write_clip(patch, *file, clip, {});
  std::uint64_t bytes = 0;
  const std::string keyed = test_out(name + "_wiggle.glb");
  REQUIRE(pipeline::write_output(patch, *file, keyed, bytes, diagnostics));
  if (!rigged.model.empty()) made_from(keyed, rigged.model);
  return {std::move(rigged), clip.name, keyed};
}

pipeline::Baked bake_wiggle(const Wiggle& wiggle, const std::string& out,
                            const pipeline::BakeRequest& settings) {
  Diagnostics diagnostics;
  pipeline::BakeRequest request = settings;
  request.file = wiggle.keyed;
  request.clips = {wiggle.name};
  request.start = 0;
  request.end = 1;
  auto baked = pipeline::bake_file(request, out, diagnostics);
  REQUIRE_MESSAGE(baked, render(diagnostics, false));
  CHECK_FALSE(baked->clips.front().passed_through);
  if (!wiggle.rigged.model.empty()) made_from(out, wiggle.rigged.model);
  return std::move(*baked);
}

std::vector<DrivenJoint> evaluate_joints(const Wiggle& wiggle, const std::vector<double>& seconds,
                                         const std::vector<math::Affine>& spaces) {
  Diagnostics diagnostics;
  const auto file = gltf::open(wiggle.keyed, diagnostics);
  REQUIRE(file);
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics);
  REQUIRE_MESSAGE((rigs && clips), render(diagnostics, false));
  const gltf::Rig& rig = rigs->front();
  const auto clip = std::find_if(clips->clips.begin(), clips->clips.end(),
                                 [&](const anim::Clip& c) { return c.name == wiggle.name; });
  REQUIRE(clip != clips->clips.end());
  const std::vector<eval::ClipInput> inputs = eval::clip_inputs(rig.scene, rig.nodes, *clip);
  std::vector<NodeId> ids;
  std::vector<DrivenJoint> joints;
  for (const NodeId id : rig.scene.nodes()) {
    if (!rig.scene[id].is_skeleton() || rig.nodes[id.index] < 0) continue;
    if (!wiggle.rigged.is_driven(id)) continue;
    ids.push_back(id);
    joints.push_back({static_cast<std::size_t>(rig.nodes[id.index]), rig.scene[id].name, {}});
  }
  for (std::size_t t = 0; t < seconds.size(); ++t) {
    std::vector<eval::Setting> settings;
    for (const eval::ClipInput& input : inputs) {
      double n[4];
      const bool rotation = input.plug.attribute == transform::kRotation;
      anim::sample(*input.curve, rotation, seconds[t], n);
      if (rotation)
        settings.push_back({input.plug, math::Quat{n[0], n[1], n[2], n[3]}});
      else if (input.curve->width == 3)
        settings.push_back({input.plug, math::Vec3{n[0], n[1], n[2]}});
      else
        settings.push_back({input.plug, n[0]});
    }
    const auto worlds = eval::worlds(rig.scene, ids, settings);
    REQUIRE(worlds.size() == joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
      joints[i].worlds.push_back(spaces[t] * worlds[i]);
  }
  return joints;
}

std::vector<math::Affine> spaces_of(const Wiggle& wiggle,
                                    const std::vector<std::vector<math::Affine>>& worlds) {
  const int ancestor = wiggle.rigged.rig->ancestor;
  std::vector<math::Affine> spaces;
  for (const auto& of_nodes : worlds)
    spaces.push_back(ancestor < 0 ? math::Affine{} : of_nodes[static_cast<std::size_t>(ancestor)]);
  return spaces;
}

std::vector<double> times_at(int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i)
    times.push_back(static_cast<double>(static_cast<float>(static_cast<double>(i) / count)));
  return times;
}

double apart(const math::Affine& a, const math::Affine& b, double limb) {
  double largest = math::length(a.origin - b.origin);
  for (const auto axis : {&math::Mat3::x, &math::Mat3::y, &math::Mat3::z}) {
    const double length = math::length(b.linear.*axis);
    if (length > 0)
      largest = std::max(largest, math::length(a.linear.*axis - b.linear.*axis) * limb / length);
  }
  return largest;
}

}  // namespace rigc::test
