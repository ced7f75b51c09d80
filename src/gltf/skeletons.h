// SPDX-License-Identifier: MIT
// Skeletons of a foreign file in their rest pose. Test: tests/gltf/skeletons_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/file.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// Every skeleton of a file: skins that share joints or whose joints hang under one another are one
/// skeleton. Non-joint nodes between joints belong to it. `rest`: "bind" (inverse bind matrices;
/// joints outside a skin keep their local transform), "nodes", or "CLIP@SECONDS". Rest matrices are
/// in the space of the lowest common non-joint ancestor.
std::optional<std::vector<tags::ForeignSkeleton>> read_skeletons(const File& file,
                                                                 const std::string& rest,
                                                                 Diagnostics& diagnostics);

}  // namespace rigc::gltf
