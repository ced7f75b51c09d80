// SPDX-License-Identifier: MIT
// What animators set in a file without keying it. Test: tests/gltf/rig_read_test.cpp
#pragma once

#include <vector>

#include "gltf/rig.h"
#include "gltf/slim.h"

namespace rigc::gltf {

/// Transforms and extras of controls that differ, beyond the rounding of 32-bit floats, from what
/// the scene says are set in the scene. Connected attributes are left alone: the rig drives them.
/// `nodes`: of the file.
void take_over_pose(const File& file, const Slim& slim, const std::vector<json::Value>& nodes,
                    Rig& rig, Diagnostics& diagnostics);

}  // namespace rigc::gltf
