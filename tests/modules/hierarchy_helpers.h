// SPDX-License-Identifier: MIT
// What models do to the hierarchy of a skeleton: joints hang elsewhere, twist joints lie between,
// joints are scaled. No joint of the template moves at rest.
#pragma once

#include <string>

#include "support/rig.h"

namespace rigc::test {

/// Hangs a joint under another one that comes before it, or (empty) under nothing.
void rehang(tags::TaggedSkeleton& skeleton, const std::string& joint, const std::string& parent);

/// Every joint hangs under `parent`, or (empty) under nothing.
void flatten(tags::TaggedSkeleton& skeleton, const std::string& parent);

/// Puts an untagged joint between a joint and its parent, beside the bone, turned by itself and
/// scaled: the joint below stays as large as it was.
void put_between(tags::TaggedSkeleton& skeleton, const std::string& joint, double scale);

/// Scales a joint and all below; every joint stays where it is.
void scale_below(tags::TaggedSkeleton& skeleton, const std::string& joint, double scale);

}  // namespace rigc::test
