// SPDX-License-Identifier: MIT
// A first guess at the map of a model that no map fits: by the names that maps know, by words, by
// the hierarchy and by how the bones lie at rest. Out comes a map file to edit.
// Test: tests/templates/map_guess_test.cpp
#pragma once

#include <string>
#include <vector>

#include "templates/map.h"

namespace rigc::templates {

/// A line of the map to be.
struct GuessLine {
  enum class Sure {
    name,     ///< a map knows the name
    word,     ///< a word of the name says so, and its place does
    place,    ///< how the bones lie
    missing,  ///< nothing fits
  };
  std::string local, label;  ///< label empty: the group's chain
  std::string joint;         ///< name in the template
  bool required = false;
  bool helper = false;  ///< rigc makes it where the model has none
  bool chain = false;
  std::vector<int> bones;  ///< indices into ForeignSkeleton::joints
  Sure sure = Sure::missing;
  std::string why;
  std::vector<int> candidates;  ///< of a missing joint
};

struct Guess {
  std::string nearest;           ///< the map that finds most; empty: none finds anything
  bool fits = false;             ///< it leaves no required joint without one
  std::vector<GuessLine> lines;  ///< in the template's order
  std::vector<int> unmapped;     ///< bones that no line names
  std::vector<std::string> notes;
  std::size_t count(GuessLine::Sure sure) const;
  std::size_t missing_required() const;
};

/// Reports nothing but what is wrong with the maps and the template themselves.
std::optional<Guess> guess_map(const Expanded& expanded, const tags::ForeignSkeleton& skeleton,
                               const std::vector<std::string>& template_folders,
                               Diagnostics& diagnostics);

/// How a map names each bone: by its name where that is unique, else by its node.
std::vector<std::string> bone_references(const tags::ForeignSkeleton& skeleton);

/// The map file: one line a joint, grouped, with comments that say how sure each is.
std::string map_text(const Guess& guess, const tags::ForeignSkeleton& skeleton,
                     const std::string& map_name, const std::string& model,
                     const std::string& template_name);

}  // namespace rigc::templates
