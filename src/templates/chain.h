// SPDX-License-Identifier: MIT
// The joints that a chain becomes, whoever gives them their places. Test:
// tests/templates/place_test.cpp
#pragma once

#include <cstdint>

#include "templates/expand.h"

namespace rigc::templates {

/// The joint of a chain at `ordinal`, or a plain joint at 0, without rest and parent: the first
/// carries the tags and the label, all carry the groups.
tags::TaggedJoint joint_of(const ExpandedJoint& joint, std::uint32_t ordinal);

/// Without the noise of computing: scales that are 1, lengths below a picometre.
math::Trs tidy(math::Trs trs);
/// A length without what sums round off, so that two ways to measure it agree.
double tidy_length(double length);

}  // namespace rigc::templates
