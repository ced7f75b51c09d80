// SPDX-License-Identifier: MIT
// A skeleton that guides moved, and where it was fitted: every joint that they moved or turned has
// its rest from before (Guiding::fitted). Test: tests/tags/fitted_test.cpp
#pragma once

#include <set>

#include "tags/tags.h"

namespace rigc::tags {

/// The skeleton as it was placed or fitted, before guides; how far they moved joints stays said.
TaggedSkeleton as_fitted(TaggedSkeleton skeleton);

/// Notes in a skeleton where its joints were fitted. `fitted` has the same joints; what differs
/// from it by rounding becomes the same.
void note_fitted(TaggedSkeleton& skeleton, const TaggedSkeleton& fitted);

/// Joints that somebody placed otherwise than by guides: where they stand they are fitted.
void settle(TaggedSkeleton& skeleton, const std::set<JointKey>& joints);

}  // namespace rigc::tags
