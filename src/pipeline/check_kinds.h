// SPDX-License-Identifier: MIT
// The checks of each kind of file, and finding the files of a folder. Only for check*.cpp.
// Test: tests/pipeline/check_test.cpp
#pragma once

#include <string>
#include <vector>

#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/check.h"

namespace rigc::pipeline {

/// Files of a folder and of those below it that are to be checked, sorted by path.
std::vector<std::string> files_to_check(const std::string& folder);
bool is_gltf(const std::string& path);
/// What a YAML text is by its keys: template, map or module; empty: something else.
std::string yaml_kind(const std::string& path, Diagnostics& diagnostics);

/// A .glb, .gltf or .vrm: a rig or a model that may get one.
void check_gltf(const CheckRequest& request, CheckedFile& out, Diagnostics& diagnostics);

/// What a rig's nodes say against what RIGC_rig says.
void check_identities(const gltf::File& file, const std::vector<gltf::Rig>& rigs,
                      Diagnostics& diagnostics);
/// Channels that have no effect, or another than their keys say.
void check_clips(const std::string& path, const gltf::Rig& rig,
                 const std::vector<anim::Clip>& clips, Diagnostics& diagnostics);
/// Whether a template and a map fit the skeletons of a model.
void check_model(const gltf::File& file, const CheckRequest& request, CheckedFile& out,
                 Diagnostics& diagnostics);

/// Writes pins of the modules that a template uses and does not pin; what is pinned stays.
void pin_modules(const std::string& path, const catalog::Catalogue& catalogue, CheckedFile& out,
                 Diagnostics& diagnostics);

}  // namespace rigc::pipeline
