// SPDX-License-Identifier: MIT
// A small rig with limits, locks, a layer and sets, as a file: for tests of what is told of them.
#pragma once

#include <string>
#include <vector>

#include "anim/clip.h"
#include "gltf/rig.h"

namespace rigc::test {

/// Builds a door with a handle into a file of the tests' output folder and gives its path. The
/// hinge: no translation, turns about y up to 90 degrees; the handle: moves along z by 0 to 0.2,
/// attribute `stiff` locked, `sound` hidden.
std::string door(const std::string& name);
/// Its rig, read back.
gltf::Rig door_rig(const std::string& path);
/// glTF node of the control of a joint.
int control_of(const gltf::Rig& rig, const std::string& label);

/// A copy of the file with a clip of these channels; gives its path.
std::string with_clip(const std::string& path, const std::vector<anim::Channel>& channels);
/// A channel with a key each tenth of a second.
anim::Channel keys(int node, anim::Path path, int width, std::vector<float> values);
anim::Channel attribute_keys(int node, const std::string& attribute, std::vector<float> values);

}  // namespace rigc::test
