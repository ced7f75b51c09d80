// SPDX-License-Identifier: MIT
// Values of a scene node in RIGC_rig: attributes, attributes of users, connections.
// Test: tests/gltf/rig_json_test.cpp
#pragma once

#include "base/json.h"
#include "gltf/rig_json_reader.h"
#include "scene/edit.h"

namespace rigc::gltf {

/// `values`, `user` and `inputs` of an open object.
void write_values(json::Writer& writer, const scene::Scene& scene, scene::NodeId id);

void read_values(const json::Value& object, JsonReader& reader, scene::Edit& edit, scene::NodeId id);
/// All nodes have their values by now.
void read_inputs(const json::Value& object, JsonReader& reader, scene::Edit& edit, scene::NodeId id);

std::string_view name_of(scene::UserAttribute::Flavour flavour);

}  // namespace rigc::gltf
