// SPDX-License-Identifier: MIT
// Parts of inspect: controls with what animators may do with them, layers, sets.
// Test: tests/pipeline/inspect_test.cpp
#pragma once

#include <string>

#include "base/json.h"
#include "gltf/rig.h"

namespace rigc::pipeline {

/// Members `controls`, `layers` and `sets` of an open object.
void write_controls(json::Writer& w, const gltf::Rig& rig);
void write_layers(json::Writer& w, const gltf::Rig& rig);
void write_sets(json::Writer& w, const gltf::Rig& rig);

/// Lines for people: one for each layer and each set.
std::string groups_text(const gltf::Rig& rig);

}  // namespace rigc::pipeline
