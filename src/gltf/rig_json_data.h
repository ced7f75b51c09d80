// SPDX-License-Identifier: MIT
// Data of scene nodes that viewers, bridges and solvers take at their word. Test:
// tests/hostile/rig_test.cpp
#pragma once

#include "gltf/rig_json_reader.h"
#include "scene/scene.h"

namespace rigc::gltf {

/// Reports what no module would have built: bits that mean nothing, lines that end before their
/// points, parts of meshes without numbers. `values`: where the node's values stand. Solvers and
/// curves are checked when they are compiled.
void check_data(const json::Value& values, JsonReader& reader, const scene::Scene& scene,
                scene::NodeId id);

}  // namespace rigc::gltf
