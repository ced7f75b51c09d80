// SPDX-License-Identifier: MIT
// New versions of templates on a character that has been rigged: placed as its rig is, or fitted to
// the same bones of its model. Test: tests/pipeline/update_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "gltf/rig.h"
#include "templates/expand.h"
#include "templates/map.h"

namespace rigc::pipeline {

/// The maps of the template folders, and what was wrong with some.
struct KnownMaps {
  Diagnostics diagnostics;
  std::vector<templates::Map> maps;
};

/// Whether any joint of a rig is a bone of its file's model.
bool is_fitted(const tags::TaggedSkeleton& skeleton);

/// Where the main templates of a rig stand in TaggedSkeleton::templates: the first, and those of
/// rigs that were joined to it.
std::vector<std::size_t> main_templates(const std::vector<tags::TemplateReference>& templates);

/// The next skeleton of a rig. `mains`: what its main templates are now, in their order. `maps`:
/// for joints of a fitted rig that are new, else null; their spans point into the sources of
/// `diagnostics`, and what is wrong with them is reported where they are needed. With
/// `take_skeleton` joints go where the templates, or the bones, have them; else they stay.
std::optional<tags::TaggedSkeleton> place_again(
    const std::vector<const templates::Expanded*>& mains, const gltf::File& file,
    const gltf::Rig& old, const KnownMaps* maps, bool take_skeleton, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
