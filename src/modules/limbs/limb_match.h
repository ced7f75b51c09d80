// SPDX-License-Identifier: MIT
// What the rig says about keying a limb in FK and in IK (scene::match), for programs that carry
// poses from one to the other. Test: tests/modules/limb_match_test.cpp
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "modules/limbs/limb.h"

namespace rigc::modules {

/// Attributes and what they mean: a word of scene::match::kMeanings each.
using Meanings = std::vector<std::pair<std::string, Plug>>;

/// The node of a limb. `limb.ik_weight` is the switch.
NodeId make_match(Builder& b, const LimbParts& limb, const Meanings& meanings);

/// A control that goes along with what keys the limb: above it, as a shoulder, or at its end, as
/// toes. Nothing where `match` is
/// invalid: a limb by FK or by IK alone.
void add_held(Builder& b, NodeId match, NodeId control);

/// Adds to the node of a limb.
void add_meanings(Builder& b, NodeId match, const Meanings& meanings);

}  // namespace rigc::modules
