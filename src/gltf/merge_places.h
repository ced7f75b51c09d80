// SPDX-License-Identifier: MIT
// Indices of one file as they are in the merged one. Inside of merge*.cpp.
// Test: tests/gltf/merge_test.cpp
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/file.h"
#include "gltf/merge_edits.h"
#include "gltf/rig.h"

namespace rigc::gltf {

/// Where the elements of a file are in the merged one.
struct Places {
  /// By top-level array, or by `EXTENSION.ARRAY` of the root: the new index of each element.
  std::map<std::string, std::vector<int>, std::less<>> arrays;
  std::map<std::uint32_t, std::uint32_t> rigs;  ///< ids, old to new

  /// -1 where the file has no such element.
  int find(std::string_view array, std::int64_t index) const;
};

/// Reports each extension that the file has and merge_table.h does not.
bool check_extensions(const File& file, Diagnostics& diagnostics);

/// Edits every index of the file but those in bufferViews and RIGC_rig, and the identities that
/// nodes carry.
bool remap(const File& file, const Places& places, Edits& edits, Diagnostics& diagnostics);

/// Edits ids, nodes, identities and what is owned in the texts of a file's rigs. `rigs`: as read
/// from the file.
void remap_rigs(const File& file, const std::vector<Rig>& rigs, const Places& places, Edits& edits);

/// An identity, or that of an orphan (`orphan:...`), with the rig's new id; empty for other texts.
std::optional<std::string> renumbered(const std::string& text, const Places& places);
/// Ids that a file's rigs have, and that its nodes mention.
std::vector<std::uint32_t> rig_ids(const File& file, const std::vector<Rig>& rigs);

/// A JSON pointer with the index behind a top-level array, or a united one, as it is now; empty
/// where it leads into anything else that is counted.
std::optional<std::string> remapped_pointer(const std::string& pointer, const Places& places);

}  // namespace rigc::gltf
