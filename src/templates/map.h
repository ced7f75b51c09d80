// SPDX-License-Identifier: MIT
// Maps: which bone of a kind of model is which joint of a template. Data in templates/maps/*.yaml;
// the one step of rigc that goes by names. Test: tests/templates/map_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "tags/tags.h"

namespace rigc::templates {

/// One line of a map: a joint, or a chain of joints, and what its bones may be called.
struct MapEntry {
  std::string local;  ///< group of the template
  std::string label;  ///< empty: the group's chain
  std::vector<std::vector<std::string>>
      bones;  ///< of a chain: in order; each a list of names, first found wins
  Span span;
};

struct Map {
  std::string name;
  std::string title;
  bool humanoid = false;              ///< names are those of the VRM humanoid table, not of nodes
  std::vector<std::string> prefixes;  ///< cut from bone names; `#` stands for any digits, or none
  std::vector<std::string> suffixes;
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

/// The map that finds most of its bones in the skeleton, of those whose required bones are all
/// there. None fits: an error that lists the maps.
std::optional<Map> detect_map(const tags::ForeignSkeleton& skeleton,
                              const std::vector<std::string>& template_folders,
                              Diagnostics& diagnostics);

/// Bones of a skeleton by the names that a map uses, compared without case.
class BoneNames {
 public:
  BoneNames(const Map& map, const tags::ForeignSkeleton& skeleton);
  /// Index into ForeignSkeleton::joints; -1: none. Of several, the first in a skin, else the first.
  int find(std::string_view bone) const;
  /// All names without what the map cuts off, sorted: for suggestions.
  std::vector<std::string> names() const;

 private:
  struct Bone {
    std::string folded;  ///< as compared
    std::string name;
    int joint;
  };
  std::vector<Bone> sorted_;
};

}  // namespace rigc::templates
