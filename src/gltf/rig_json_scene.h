// SPDX-License-Identifier: MIT
// The scene of a rig in RIGC_rig: nodes in the order made, values that differ from their kind's
// defaults, connections. Test: tests/gltf/rig_json_test.cpp
#pragma once

#include "base/json.h"
#include "gltf/rig.h"
#include "gltf/rig_places.h"

namespace rigc::gltf {

/// Member `nodes` of an open object.
void write_scene(json::Writer& writer, const Rig& rig, PlaceWriter& places);
/// Fills rig.scene and rig.nodes; id, skeleton and commands of the rig are there already.
void read_scene(const json::Value& object, JsonReader& reader, PlaceReader& places, Rig& rig);

}  // namespace rigc::gltf
