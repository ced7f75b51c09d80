// SPDX-License-Identifier: MIT
// A template's skeleton on a character that has been built before: joints are found by uid and stay
// where they were fitted or edited. Test: tests/update/skeleton_test.cpp
#pragma once

#include <string>
#include <vector>

#include "tags/tags.h"

namespace rigc::update {

/// By joint of `fresh`: the joint of `old` that it is, by key, then by what either says that it
/// was; -1: none. No joint of `old` is given twice.
std::vector<int> counterparts(const tags::TaggedSkeleton& fresh, const tags::TaggedSkeleton& old);

/// Puts joints where their counterparts stand in rig space, with the same transform where they hang
/// on the same joint. New joints keep their transform below their parent. A chain with another
/// number of joints is spread along the old one, from its first to its last joint. The character
/// (up, height) becomes the old one. What guides moved stays moved.
void keep_placements(tags::TaggedSkeleton& fresh, const tags::TaggedSkeleton& old);

}  // namespace rigc::update
