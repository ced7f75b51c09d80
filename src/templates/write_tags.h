// SPDX-License-Identifier: MIT
// The tags of a joint as text, as people write them: only for write.cpp.
// Test: tests/templates/write_test.cpp
#pragma once

#include <map>
#include <string>

#include "catalog/catalogue.h"
#include "tags/tags.h"

namespace rigc::templates {

/// What the catalogue of features has to say as default, so that as few tags as possible say
/// otherwise: what all tags of a feature are; where they differ, what it was declared.
std::map<std::string, bool> feature_defaults(const tags::TaggedSkeleton& skeleton);

/// `tags:` with everything below, indented as in a list of joints; empty without commands.
std::string tags_text(const tags::TaggedJoint& joint, const catalog::Catalogue& catalogue,
                      const std::map<std::string, bool>& defaults, std::size_t columns);

}  // namespace rigc::templates
