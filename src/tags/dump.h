// SPDX-License-Identifier: MIT
// A tagged skeleton as text, one line for each joint and tag: for tests, diffs and people.
// Test: tests/tags/tags_test.cpp
#pragma once

#include <string>

#include "tags/tags.h"

namespace rigc::tags {

/// Deterministic; everything that a rig is built from, without spans.
std::string dump(const TaggedSkeleton& skeleton);

}  // namespace rigc::tags
