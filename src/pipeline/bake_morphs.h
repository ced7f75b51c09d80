// SPDX-License-Identifier: MIT
// Weights of morph targets that a rig drives (scene kind morph): which meshes of a file have them,
// and their channels in a bake. Test: tests/pipeline/morphs_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "gltf/morphs.h"
#include "gltf/rig.h"

namespace rigc::pipeline {

/// A mesh of which a rig drives some targets.
struct DrivenMorphs {
  gltf::MorphedNode mesh;
  struct Driven {
    std::size_t target;  ///< in mesh.targets
    scene::Plug weight;  ///< of the rig
  };
  std::vector<Driven> driven;
};

/// What the rig's morph nodes drive in a file. Targets that no mesh there has are reported.
/// `before`: the rig of the file that this one replaces, whose joints it has.
std::vector<DrivenMorphs> find_driven_morphs(const gltf::File& file, const gltf::Slim& slim,
                                             const gltf::Rig& rig, Diagnostics& diagnostics,
                                             const gltf::Rig* before = nullptr);

/// The same report for a rig that was just built for a model.
void report_missing_morphs(const gltf::File& model, const gltf::Rig& rig, Diagnostics& diagnostics,
                           const gltf::Rig* before = nullptr);

/// Channels on the weights of these meshes at `times` (seconds) of a clip: what the rig drives as
/// it says, the other targets as the clip of the file has them. Meshes whose weights stay what they
/// are in the file have none. Empty where the rig cannot be evaluated, or what the clip has there
/// is damaged (reported).
std::optional<std::vector<anim::Channel>> bake_morphs(const gltf::File& file,
                                                      const gltf::Slim& slim, const gltf::Rig& rig,
                                                      const std::vector<DrivenMorphs>& morphs,
                                                      const anim::Clip& clip,
                                                      const std::vector<float>& times,
                                                      Diagnostics& diagnostics);

}  // namespace rigc::pipeline
