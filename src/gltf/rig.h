// SPDX-License-Identifier: MIT
// A built rig as it is written into and read from a file. Test: tests/gltf/rig_test.cpp
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gltf/file.h"
#include "gltf/patch.h"
#include "scene/scene.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// One executed command, for inspect and for messages.
struct CommandRecord {
  JointKey holder;
  std::string joint;         ///< name of the joint that holds it
  std::string id;
  std::string module;
  bool ran = true;           ///< false: skipped because an optional selector was empty
  std::string file;          ///< of the template line
  int line = 0;
};

struct Rig {
  std::uint32_t id = 0;                       ///< number of the rig, unique in its file
  tags::TaggedSkeleton skeleton;
  tags::Settings settings;
  std::vector<std::pair<std::string, int>> modules;   ///< name and version of each that made something
  std::vector<CommandRecord> commands;        ///< in the order they ran; Node::command is an index into it
  scene::Scene scene;
  std::vector<int> nodes;                     ///< glTF node of each scene node, -1: none (constraints and other utilities)
};

/// Appends a rig to a file (or to empty_file()): nodes, control shapes, proxy mesh and skin, RIGC_rig, identities.
/// Joints with a foreign node keep it untouched but for extras.rigc. `ancestor`: node that the rig's roots go under, -1: the scene.
/// Fills rig.nodes.
bool write_rig(Patch& patch, Rig& rig, int ancestor, Diagnostics& diagnostics);

/// All rigs of a file, ordered by id, with what animators set without keying (transforms, extras) taken over
/// into the scenes. A file without any gives an empty list. A RIGC_rig that lies about itself is an error.
std::optional<std::vector<Rig>> read_rigs(const File& file, Diagnostics& diagnostics);

}  // namespace rigc::gltf
