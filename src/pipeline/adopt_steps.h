// SPDX-License-Identifier: MIT
// The steps of adopting: who is who, clips, values, joints. Only for the adopt*.cpp of this folder.
// Test: tests/pipeline/adopt_test.cpp
#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "gltf/clips.h"
#include "gltf/rig.h"
#include "gltf/slim.h"
#include "pipeline/adopt.h"

namespace rigc::pipeline {

/// A node of the edited file and the one of the original that it is.
struct Twin {
  int edited = -1, original = -1;  ///< glTF nodes
  const gltf::Rig* rig = nullptr;  ///< of the original
  scene::NodeId id;
  bool is_control() const { return rig->scene[id].kind == scene::Kind::control; }
};

/// A file with what adopting needs of it.
struct Side {
  gltf::File file;
  gltf::Slim slim;
  gltf::ClipFile clips;
};

/// What is animated: node of the original and path.
using Target = std::pair<int, anim::Path>;

/// Pairs nodes by identity; reports copies, strangers, and that there is nothing at all.
std::optional<std::vector<Twin>> find_twins(const Side& edited, const Side& original,
                                            const std::vector<gltf::Rig>& rigs, Adopted& report,
                                            Diagnostics& diagnostics);

/// The clips to write. `keyed` gets the transforms of controls that some clip keys in the result.
std::optional<std::vector<gltf::ClipChange>> adopt_clips(const AdoptRequest& request,
                                                         const Side& edited, const Side& original,
                                                         const std::vector<Twin>& twins,
                                                         std::set<Target>& keyed, Adopted& report,
                                                         Diagnostics& diagnostics);

/// Transforms and attributes that differ without being keyed.
void adopt_values(const Side& edited, const Side& original, const std::vector<Twin>& twins,
                  const std::set<Target>& keyed, gltf::Patch& patch, Adopted& report);

/// Joints that rest elsewhere below their parents.
void adopt_joints(const Side& edited, const Side& original, const std::vector<Twin>& twins,
                  gltf::Patch& patch, Adopted& report);

/// Whether two values are one but for what another program's arithmetic does to them: lengths
/// relative to the character's height, rotations whatever the sign of the quaternion.
bool same_value(const Twin& twin, anim::Path path, const double* a, const double* b);

}  // namespace rigc::pipeline
