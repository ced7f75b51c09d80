// SPDX-License-Identifier: MIT
// What the four weighted constraints share: targets, weights, weight attributes, axes.
// Test: tests/modules/constraints_test.cpp
#pragma once

#include "modules/steps.h"

namespace rigc::modules {

/// Targets with the worlds that they follow; fails where one has no place in space.
std::vector<Target> constraint_targets(Builder& b);

/// Weights as written, all 1 where they were left out; fails where they do not fit the targets.
std::vector<double> constraint_weights(Builder& b, std::size_t targets);

/// One keyable attribute for each weight on the node of `weights_on:`; none where that was left
/// out.
std::vector<Plug> weight_attributes(Builder& b, const std::vector<double>& weights);

/// The same, connected to the weights
/// array of `constraint`.
void connect_weights(Builder& b, NodeId constraint, std::uint16_t weights_attribute,
                     const std::vector<double>& weights);

/// The driven node; fails where it has no place in space.
NodeId driven_node(Builder& b);

/// Connects `from` into a vector attribute of `node`: whole where `axes` is xyz, else component by
/// component.
void connect_axes(Builder& b, const Plug& from, const Plug& to, const std::string& axes);

/// point, orient and scale constraints: one output, per axis.
void weighted_constraint(Builder& b, scene::Kind kind);

}  // namespace rigc::modules
