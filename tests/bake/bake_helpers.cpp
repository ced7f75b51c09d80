// SPDX-License-Identifier: MIT
// Scenes and clips for the tests of src/bake.
#include "bake_helpers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "eval/evaluate.h"

namespace rigc::bake::test {

using scene::Kind;
using scene::NodeId;
namespace transform = scene::transform;

NodeId Stage::joint(const std::string& name, NodeId parent, const math::Trs& rest) {
  scene::Node node;
  node.kind = Kind::joint;
  node.name = name;
  node.parent = parent;
  node.identity.owner.uid = scene.size() + 1;
  const NodeId id = edit.make(node);
  set_rest(id, rest);
  return id;
}

NodeId Stage::made(Kind kind, const std::string& name, NodeId parent) {
  scene::Node node;
  node.kind = kind;
  node.name = name;
  node.parent = parent;
  node.command = 0;
  return edit.make(node);
}

void Stage::set_rest(NodeId node, const math::Trs& rest) {
  edit.set({node, transform::kTranslate}, rest.translation);
  edit.set({node, transform::kRotation}, rest.rotation);
  edit.set({node, transform::kScale}, rest.scale);
}

NodeId Stage::control_for(NodeId joint, NodeId parent) {
  const NodeId zero = made(Kind::transform, "zero", parent);
  const math::Affine above = parent.valid() ? scene.rest_world(parent) : math::Affine{};
  set_rest(zero, math::decompose(math::inverse(above) * scene.rest_world(joint)));
  const NodeId control = made(Kind::control, "control", zero);
  const NodeId driver = made(Kind::parent_constraint, "driver");
  namespace constraint = scene::constraint;
  edit.connect({joint, transform::kParent}, {driver, constraint::kParent});
  edit.connect({control, transform::kWorld}, {driver, constraint::kTargets, 0});
  edit.set({driver, constraint::kWeights, 0}, 1.0);
  edit.set({driver, constraint::kOffsets, 0}, math::Affine{});
  edit.connect({driver, constraint::kTranslate}, {joint, transform::kTranslate});
  edit.connect({driver, constraint::kRotation}, {joint, transform::kRotation});
  return control;
}

std::vector<int> Stage::nodes() const {
  std::vector<int> nodes;
  for (const NodeId id : scene.nodes())
    nodes.push_back(scene::spec(scene[id].kind).is_transform ? static_cast<int>(id.index) : -1);
  return nodes;
}

anim::Channel channel(NodeId node, anim::Path path, std::vector<float> times,
                      std::vector<float> values, anim::Interpolation interpolation) {
  anim::Channel out;
  out.node = static_cast<int>(node.index);
  out.path = path;
  out.curve.width = path == anim::Path::attribute ? 1 : path == anim::Path::rotation ? 4 : 3;
  out.curve.interpolation = interpolation;
  out.curve.times = std::make_shared<std::vector<float>>(std::move(times));
  out.curve.values = std::move(values);
  return out;
}

std::vector<math::Affine> evaluated(const Stage& stage, const anim::Clip& clip, double seconds) {
  std::vector<eval::Setting> settings;
  for (const anim::Channel& c : clip.channels) {
    const NodeId node{static_cast<std::uint32_t>(c.node)};
    double n[4];
    anim::sample(c.curve, c.path == anim::Path::rotation, seconds, n);
    if (c.path == anim::Path::translation)
      settings.push_back({{node, transform::kTranslate}, math::Vec3{n[0], n[1], n[2]}});
    if (c.path == anim::Path::rotation)
      settings.push_back({{node, transform::kRotation}, math::Quat{n[0], n[1], n[2], n[3]}});
    if (c.path == anim::Path::scale)
      settings.push_back({{node, transform::kScale}, math::Vec3{n[0], n[1], n[2]}});
    if (c.path == anim::Path::attribute)
      settings.push_back({*stage.scene.find_plug(node, c.attribute), n[0]});
  }
  std::vector<NodeId> transforms;
  for (const NodeId id : stage.scene.nodes())
    if (scene::spec(stage.scene[id].kind).is_transform) transforms.push_back(id);
  const auto worlds = eval::worlds(stage.scene, transforms, settings);
  REQUIRE(worlds.size() == transforms.size());
  std::vector<math::Affine> out(stage.scene.size());
  for (std::size_t i = 0; i < transforms.size(); ++i) out[transforms[i].index] = worlds[i];
  return out;
}

std::vector<Standing> as_scene(const Stage& stage) {
  std::vector<Standing> out(stage.scene.size());
  for (const NodeId id : stage.scene.nodes())
    if (scene::spec(stage.scene[id].kind).is_transform)
      out[id.index] = {stage.scene[id].parent, {}, stage.scene.local(id)};
  return out;
}

std::vector<math::Affine> played(const Stage& stage, const std::vector<Standing>& standings,
                                 const anim::Clip& clip, double seconds) {
  std::vector<math::Trs> locals;
  for (const Standing& standing : standings) locals.push_back(standing.local);
  for (const anim::Channel& c : clip.channels) {
    math::Trs& local = locals[static_cast<std::size_t>(c.node)];
    double n[4];
    anim::sample(c.curve, c.path == anim::Path::rotation, seconds, n);
    if (c.path == anim::Path::translation) local.translation = {n[0], n[1], n[2]};
    if (c.path == anim::Path::rotation) local.rotation = {n[0], n[1], n[2], n[3]};
    if (c.path == anim::Path::scale) local.scale = {n[0], n[1], n[2]};
  }
  std::vector<math::Affine> worlds(standings.size());
  for (const NodeId id : stage.scene.nodes()) {
    math::Affine world;
    for (NodeId at = id; at.valid(); at = standings[at.index].base)
      world = standings[at.index].between * math::compose(locals[at.index]) * world;
    worlds[id.index] = world;
  }
  return worlds;
}

double difference(const math::Affine& a, const math::Affine& b) {
  double largest = math::length(a.origin - b.origin);
  for (const auto axis : {&math::Mat3::x, &math::Mat3::y, &math::Mat3::z})
    largest = std::max(largest, math::length(a.linear.*axis - b.linear.*axis));
  return largest;
}

const anim::Channel* find(const anim::Clip& clip, NodeId node, anim::Path path) {
  for (const anim::Channel& c : clip.channels)
    if (c.node == static_cast<int>(node.index) && c.path == path) return &c;
  return nullptr;
}

anim::Clip baked(const Stage& stage, const anim::Clip& clip, const Options& options,
                 Report& report) {
  Diagnostics diagnostics;
  auto out = bake::bake(stage.scene, stage.nodes(), clip, options, report, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(out);
  CHECK(diagnostics.all().empty());
  return std::move(*out);
}

}  // namespace rigc::bake::test
