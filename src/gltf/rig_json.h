// SPDX-License-Identifier: MIT
// A rig as the text of one entry of RIGC_rig's `rigs`, and back. Everything is checked on the way
// in. The format: docs/RIGC_rig.md, docs/schema/RIGC_rig.schema.json. Test:
// tests/gltf/rig_json_test.cpp
#pragma once

#include <optional>
#include <string>

#include "gltf/rig.h"

namespace rigc::gltf {

inline constexpr int kRigVersionNumber = 1;
inline constexpr std::size_t kMostRigs = 1024;
inline constexpr std::size_t kMostJoints = 16384;
inline constexpr std::size_t kMostNodes = 32768;  ///< of a rig, and of all rigs of a file
inline constexpr std::size_t kMostDepth = 1024;
inline constexpr std::size_t kMostElements = 4096;  ///< of an array attribute

/// One JSON object. Names of files lose the folder that the main template lies in, so that the same
/// rig gives the same text wherever it was built.
std::string to_json(const Rig& rig, const Sources& sources);

/// The reverse; `file` is the name for messages. Sources of the rig's files are added without their
/// texts. Indices of glTF nodes are only checked not to be below -1. With Origins::file nodes come
/// from where they stand in the file, not from the template's lines. `room`: how many parts it may
/// have, and how many are left for the next rig.
std::optional<Rig> from_json(const json::Value& object, const std::string& file,
                             Diagnostics& diagnostics, Origins origins = Origins::templates,
                             std::size_t* room = nullptr);

}  // namespace rigc::gltf
