// SPDX-License-Identifier: MIT
// A small rig with limits, locks, a layer and sets.
#include "pipeline/door_helpers.h"

#include <doctest/doctest.h>

#include <fstream>

#include "gltf/clips.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"

namespace rigc::test {
namespace {

constexpr const char* kDoor = R"(rigc: 1
name: door
version: 1
joints:
  - name: hinge
    at: [0, 1, 0]
    local: door
    label: hinge
    tags:
      - command: control
        with: {scale: on}
      - command: limits
        with: {min_rotate_y: 0, max_rotate_y: 90}
      - command: lock
        with: {attributes: [./control@translate, ./control@rotate.x, ./control@rotate.z], mode: lock}
      - command: control_set
        with: {set: door, parent: house}
      - command: display_layer
        with: {layer: doors, color: red, mode: reference, visible: off, switch_on: ./control}
  - name: handle
    parent: hinge
    at: [0.8, 1, 0]
    local: handle
    label: handle
    tags:
      - command: control
        with: {rotate: off}
      - {command: attribute, id: stiff, with: {attribute: stiff, default: 2}}
      - {command: attribute, id: sound, with: {attribute: sound}}
      - command: limits
        with: {min_translate_z: 0, max_translate_z: 0.2}
      - command: lock
        id: still
        with: {attributes: [./control@translate.x, ./control@translate.y, ./control@stiff], mode: lock}
      - command: lock
        id: silent
        with: {attributes: ./control@sound, mode: hide}
)";

}  // namespace

std::string door(const std::string& name) {
  const std::string path = test_out(name + ".yaml"), out = test_out(name + ".glb");
  std::ofstream(path, std::ios::binary) << kDoor;
  pipeline::BuildRequest request;
  request.template_file = path;
  Diagnostics diagnostics;
  REQUIRE_MESSAGE(pipeline::build(request, out, diagnostics), render(diagnostics, false));
  CHECK(diagnostics.all().empty());
  return out;
}

gltf::Rig door_rig(const std::string& path) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  REQUIRE(rigs->size() == 1);
  return std::move(rigs->front());
}

int control_of(const gltf::Rig& rig, const std::string& label) {
  for (scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.kind == scene::Kind::control && node.ids.label == label) return rig.nodes[id.index];
  }
  FAIL("no control " << label);
  return -1;
}

std::string with_clip(const std::string& path, const std::vector<anim::Channel>& channels) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  gltf::Patch patch(*file);
  gltf::write_clip(patch, *file, {"test", -1, channels}, {});
  const std::string out = path.substr(0, path.size() - 4) + "_keyed.glb";
  std::uint64_t bytes = 0;
  REQUIRE(pipeline::write_output(patch, *file, out, bytes, diagnostics));
  return out;
}

anim::Channel keys(int node, anim::Path path, int width, std::vector<float> values) {
  anim::Channel channel;
  channel.node = node;
  channel.path = path;
  channel.curve.width = width;
  std::vector<float> times;
  for (std::size_t i = 0; i * static_cast<std::size_t>(width) < values.size(); ++i)
    times.push_back(static_cast<float>(i) / 10);
  channel.curve.times = std::make_shared<const std::vector<float>>(std::move(times));
  channel.curve.values = std::move(values);
  return channel;
}

anim::Channel attribute_keys(int node, const std::string& attribute, std::vector<float> values) {
  anim::Channel channel = keys(node, anim::Path::attribute, 1, std::move(values));
  channel.attribute = attribute;
  return channel;
}

}  // namespace rigc::test
