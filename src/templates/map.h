// SPDX-License-Identifier: MIT
// Maps: which bone of a kind of model is which joint of a template. Data in templates/maps/*.yaml,
// or a user's own file. Test: tests/templates/map_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "tags/tags.h"
#include "templates/bone_names.h"
#include "templates/expand.h"

namespace rigc::templates {

/// One line of a map: a joint, or a chain of joints, and what its bones may be called.
struct MapEntry {
  std::string local;  ///< group of the template
  std::string label;  ///< empty: the group's chain
  std::vector<std::vector<std::string>>
      bones;            ///< of a chain: in order; each a list of names, first found wins
  bool absent = false;  ///< `~`: the model has no such bone, and that is no mistake
  Span span;
};

struct Map : NameRules {
  std::string name;
  std::string title;
  /// For detection: of each of these lists one bone must be there, prefix and all; `#` as above.
  std::vector<std::vector<std::string>> required;
  std::vector<MapEntry> entries;
  const MapEntry* find(std::string_view local, std::string_view label) const;
};

/// Reads a map file; `file` is a number from Diagnostics::sources().
std::optional<Map> read_map(std::uint32_t file, Diagnostics& diagnostics);

/// By name in the `maps` folders of the template folders, or by path.
std::optional<Map> find_map(const std::string& name_or_path,
                            const std::vector<std::string>& template_folders,
                            Diagnostics& diagnostics);

/// All maps of the template folders, by name; a folder hides maps of those after it.
std::vector<Map> all_maps(const std::vector<std::string>& template_folders,
                          Diagnostics& diagnostics);

/// How well a map serves to fit a template to a skeleton.
struct MapTrial {
  const Map* map = nullptr;
  std::vector<std::pair<std::string, int>> matched;  ///< joint and glTF node of its bone
  std::size_t required = 0;                          ///< joints of the template that must have one
  std::vector<std::string> missing;                  ///< those that have none
};

/// Tries all maps whose required bones are there, best first: fewest missing joints, then those by
/// the humanoid table, then most bones, then names as they are before words.
std::vector<MapTrial> try_maps(const std::vector<Map>& maps, const Expanded& expanded,
                               const tags::ForeignSkeleton& skeleton);

/// The map that fits the template to the skeleton best. None without missing joints: an error that
/// says which came nearest.
std::optional<Map> detect_map(const Expanded& expanded, const tags::ForeignSkeleton& skeleton,
                              const std::vector<std::string>& template_folders,
                              Diagnostics& diagnostics);

/// For a user's own map: warns of lines that no joint of the template has, and of bones that the
/// model does not have.
void check_map(const Map& map, const Expanded& expanded, const tags::ForeignSkeleton& skeleton,
               Diagnostics& diagnostics);

}  // namespace rigc::templates
