// SPDX-License-Identifier: MIT
// A model's rig, keys said in the world, and where they bring every node.
#include "pipeline/motion_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "gltf/clips.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"

namespace rigc::test {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;

/// The rig's space is what its first top-level node hangs under in the file.
Affine space_of(const Rigged& rigged) {
  const Character character = load_character(rigged.path);
  const std::vector<int> parents = parents_of(character.json);
  Affine space;
  for (NodeId id : rigged.scene().nodes()) {
    if (rigged.scene()[id].parent.valid() || rigged.gltf_node(id) < 0) continue;
    if (rigged.scene()[id].is_skeleton()) continue;  // may hang under nodes that are no joints
    for (int at = parents[static_cast<std::size_t>(rigged.gltf_node(id))]; at >= 0;
         at = parents[static_cast<std::size_t>(at)]) {
      space = local_of(character.json["nodes"][static_cast<std::size_t>(at)]) * space;
    }
    break;
  }
  return space;
}

std::vector<float> floats(std::initializer_list<double> values) {
  return {values.begin(), values.end()};
}

/// One channel for each attribute that any pose keys.
std::vector<anim::Channel> channels_of(const std::vector<Pose>& poses) {
  std::vector<float> seconds;
  for (std::size_t i = 0; i < poses.size(); ++i) seconds.push_back(static_cast<float>(i));
  const auto times = std::make_shared<const std::vector<float>>(seconds);
  using Place = std::tuple<int, anim::Path, std::string>;
  std::map<Place, std::vector<std::vector<float>>> values;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (const Key& key : poses[i]) {
      auto& keys = values[{key.node, key.path, key.attribute}];
      keys.resize(poses.size(), key.rest);
      keys[i] = key.value;
    }
  }
  std::vector<anim::Channel> channels;
  for (const auto& [place, keys] : values) {
    anim::Channel& channel = channels.emplace_back();
    std::tie(channel.node, channel.path, channel.attribute) = place;
    channel.curve.width = static_cast<int>(keys.front().size());
    channel.curve.times = times;
    for (const auto& key : keys)
      channel.curve.values.insert(channel.curve.values.end(), key.begin(), key.end());
  }
  return channels;
}

}  // namespace

NodeId Rigged::joint(const JointKey& key) const {
  for (NodeId id : scene().nodes()) {
    if (scene()[id].is_skeleton() && scene()[id].identity.owner == key) return id;
  }
  return {};
}

NodeId Rigged::joint_at(int node) const {
  for (NodeId id : scene().nodes()) {
    if (scene()[id].is_skeleton() && gltf_node(id) == node) return id;
  }
  return {};
}

bool Rigged::is_driven(NodeId joint) const {
  const auto& inputs = scene()[joint].inputs;
  return std::any_of(inputs.begin(), inputs.end(), [](const scene::Connection& connection) {
    return connection.to.attribute <= scene::transform::kRotate;
  });
}

std::vector<NodeId> Rigged::controls(const std::string& local, const std::string& role) const {
  std::vector<NodeId> found;
  for (NodeId id : scene().nodes()) {
    const scene::Node& node = scene()[id];
    if (node.kind == scene::Kind::control && node.ids.local == local && node.identity.role == role)
      found.push_back(id);
  }
  REQUIRE_MESSAGE(!found.empty(), "no control in role " << role << " of group " << local);
  return found;
}

NodeId Rigged::control(const std::string& module, const std::string& role) const {
  std::vector<NodeId> found;
  for (NodeId id : scene().nodes()) {
    const scene::Node& node = scene()[id];
    if (node.kind == scene::Kind::control && node.module == module && node.identity.role == role)
      found.push_back(id);
  }
  REQUIRE(found.size() == 1);
  return found.front();
}

math::Quat Rigged::turn_about(Vec3 axis, double radians) const {
  return math::axis_angle(math::normalised(axes * axis), radians);
}

Key Rigged::move_to(NodeId control, Vec3 point) const {
  const Vec3 t = math::inverse(world(scene()[control].parent)) * point;
  return {gltf_node(control), anim::Path::translation, {}, floats({t.x, t.y, t.z}), {0, 0, 0}};
}

Key Rigged::turn_by(NodeId control, math::Quat turn) const {
  const math::Mat3 zero = world(scene()[control].parent).linear;
  const math::Mat3 local = math::inverse(zero) * (math::matrix(turn) * zero);
  const math::Quat q = math::quaternion(math::orthonormal(local));
  return {gltf_node(control), anim::Path::rotation, {}, floats({q.x, q.y, q.z, q.w}), {0, 0, 0, 1}};
}

Key Rigged::switch_to(const std::string& group, float ik) const {
  const NodeId settings = controls(group, "settings").front();
  const double rest = scene().number(*scene().find_plug(settings, "ik_fk"));
  return {gltf_node(settings), anim::Path::attribute, "ik_fk", {ik}, floats({rest})};
}

Rigged rig_model(const std::string& model, const std::string& map, const std::string& name,
                 const std::string& template_name, const std::string& rest,
                 const std::vector<std::string>& features) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = templates_folder() + "/" + template_name;
  request.paths.templates = {templates_folder()};
  request.model = model;
  request.map = map;
  request.rest = rest;
  request.features = features;
  Rigged rigged;
  rigged.path = test_out(name + "_rig.glb");
  rigged.model = model;
  if (!model.empty()) made_from(rigged.path, model);
  const auto built = pipeline::build(request, rigged.path, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  const auto file = gltf::open(rigged.path, diagnostics);
  REQUIRE(file);
  auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  REQUIRE(rigs->size() == 1);
  rigged.rig = std::make_unique<gltf::Rig>(std::move(rigs->front()));
  rigged.space = space_of(rigged);
  const tags::Character& character = rigged.rig->skeleton.character;
  const math::Mat3& linear = rigged.space.linear;
  const Vec3 up = linear * character.up;
  rigged.axes = {math::normalised(linear * character.left), math::normalised(up),
                 math::normalised(linear * character.forward)};
  rigged.height = character.height * math::length(up);
  return rigged;
}

std::vector<std::vector<Affine>> bake_poses(const Rigged& rigged, const std::vector<Pose>& poses,
                                            const std::string& name) {
  Diagnostics diagnostics;
  const auto file = gltf::open(rigged.path, diagnostics);
  REQUIRE(file);
  gltf::Patch patch(*file);
  gltf::write_clip(patch, *file, {"test", -1, channels_of(poses)}, {});
  std::uint64_t bytes = 0;
  const std::string keyed = test_out(name + "_keyed.glb");
  REQUIRE(pipeline::write_output(patch, *file, keyed, bytes, diagnostics));
  pipeline::BakeRequest request;
  request.file = keyed;
  request.clips = {"test"};
  request.fps = "1";
  const std::string baked = test_out(name + "_baked.glb");
  const auto done = pipeline::bake_file(request, baked, diagnostics);
  REQUIRE_MESSAGE(done, render(diagnostics, false));
  CHECK_FALSE(done->clips.front().passed_through);
  made_from(keyed, rigged.model);
  made_from(baked, rigged.model);
  std::vector<double> seconds;
  for (std::size_t i = 0; i < poses.size(); ++i) seconds.push_back(static_cast<double>(i));
  return play(baked, "test", seconds);
}

}  // namespace rigc::test
