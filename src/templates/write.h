// SPDX-License-Identifier: MIT
// TaggedSkeleton -> the text of a template that builds it again: flat, without what is default, and
// the same for the same skeleton. Test: tests/templates/write_test.cpp
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "catalog/catalogue.h"
#include "tags/tags.h"

namespace rigc::templates {

struct WriteOptions {
  std::string name;                   ///< of the template
  int version = 1;                    ///< from 1
  std::vector<std::string> comments;  ///< lines above everything
  /// Versions of the modules that made the rig: older ones than the catalogue's are pinned.
  std::vector<std::pair<std::string, int>> modules;
  /// Rest matrices of the joints in rig space, where somebody knows them better than their rests
  /// say: those of a model may be sheared. Empty, or one for each joint.
  std::vector<math::Affine> worlds;
};

/// Every joint keeps its key and every command its id. Features have the state that they have in
/// the skeleton without any settings. A skeleton of a template reads back with the very same
/// places; one that was fitted is written in metres, Y up and facing +Z, and its joints have names
/// by their groups and labels.
std::string write(const tags::TaggedSkeleton& skeleton, const catalog::Catalogue& catalogue,
                  const WriteOptions& options);

}  // namespace rigc::templates
