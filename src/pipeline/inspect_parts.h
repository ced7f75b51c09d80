// SPDX-License-Identifier: MIT
// Parts of inspect: controls with what animators may do with them, layers, sets, orphans.
// Test: tests/pipeline/inspect_test.cpp
#pragma once

#include <string>

#include "base/json.h"
#include "gltf/clips.h"
#include "gltf/rig.h"

namespace rigc::pipeline {

/// Members `controls`, `layers` and `sets` of an open object.
void write_controls(json::Writer& w, const gltf::Rig& rig);
void write_layers(json::Writer& w, const gltf::Rig& rig);
void write_sets(json::Writer& w, const gltf::Rig& rig);

/// Member `orphans`: what is held without keys, and in how many channels of all clips the keys are.
void write_orphans(json::Writer& w, const gltf::Rig& rig, const gltf::ClipFile& clips);

/// Lines for people: one for each layer and each set.
std::string groups_text(const gltf::Rig& rig);
/// One for each orphan.
std::string orphans_text(const gltf::Rig& rig, const gltf::ClipFile& clips);

}  // namespace rigc::pipeline
