// SPDX-License-Identifier: MIT
// Values of a scene node in RIGC_rig: attributes, attributes of users, connections.
// Test: tests/gltf/rig_json_test.cpp
#pragma once

#include "base/json.h"
#include "gltf/rig_json_reader.h"
#include "scene/edit.h"

namespace rigc::gltf {

/// Changes a scene that nobody will want to undo: journals of whole rigs would be larger than the
/// rigs.
class SceneMaker {
 public:
  explicit SceneMaker(scene::Scene& scene) : scene_(scene) {}
  const scene::Scene& scene() const { return scene_; }
  scene::NodeId make(scene::Node node) { return Once(scene_).edit.make(std::move(node)); }
  void reparent(scene::NodeId node, scene::NodeId parent) {
    Once(scene_).edit.reparent(node, parent);
  }
  void set(const scene::Plug& plug, const scene::Value& value) {
    Once(scene_).edit.set(plug, value);
  }
  void connect(const scene::Plug& from, const scene::Plug& to) {
    Once(scene_).edit.connect(from, to);
  }
  void add_attribute(scene::NodeId node, scene::UserAttribute attribute) {
    Once(scene_).edit.add_attribute(node, std::move(attribute));
  }
  /// Whether there is room for an array of `count` elements. Setting one costs as much as there are
  /// (the journal keeps all), so that a hostile file could ask for hours.
  bool takes_array(std::size_t count) {
    if (count * count > room_) return false;
    room_ -= count * count;
    return true;
  }

 private:
  struct Once {
    explicit Once(scene::Scene& scene) : edit(scene, journal, nullptr) {}
    scene::Journal journal;
    scene::Edit edit;
  };
  scene::Scene& scene_;
  std::size_t room_ = std::size_t{1} << 28;
};

/// `values`, `user` and `inputs` of an open object.
void write_values(json::Writer& writer, const scene::Scene& scene, scene::NodeId id);

void read_values(const json::Value& object, JsonReader& reader, SceneMaker& maker,
                 scene::NodeId id);
/// All nodes have their values by now.
void read_inputs(const json::Value& object, JsonReader& reader, SceneMaker& maker,
                 scene::NodeId id);

std::string_view name_of(scene::UserAttribute::Flavour flavour);
std::optional<scene::UserAttribute::Flavour> parse_flavour(std::string_view name);

}  // namespace rigc::gltf
