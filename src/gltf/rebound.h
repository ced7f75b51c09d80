// SPDX-License-Identifier: MIT
// What a rig changed in the model's skins and primitives: as text, and undone. split_weights.h does
// it. Inside of rig*.cpp and merge*.cpp. Test: tests/gltf/split_weights_test.cpp
#pragma once

#include "gltf/rig.h"
#include "gltf/rig_json_reader.h"
#include "gltf/uses.h"

namespace rigc::gltf {

/// Member `rebound` of an open object; left out where nothing was changed.
void write_rebound(json::Writer& writer, const Rebound& rebound);
void read_rebound(const json::Value& object, JsonReader& reader, Rebound& out);

/// Whether a file is still as the rig changed it, so that it can be changed back: another program
/// may have bound anew. Never true of a rig that changed nothing.
bool is_rebound(const File& file, const Rig& rig);

/// Gives the skins and primitives of a rig of which is_rebound() holds what they had.
void unbind(Patch& patch, const Rebound& rebound, Uses& uses);

}  // namespace rigc::gltf
