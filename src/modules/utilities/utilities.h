// SPDX-License-Identifier: MIT
// What the utility modules share: nodes that only compute, and transforms that stand where a
// computed matrix says. Test: tests/modules/utilities_test.cpp
#pragma once

#include <string>
#include <vector>

#include "modules/wiring.h"

namespace rigc::modules {

/// A computing node of role `utility`: other commands read what its program gives by name,
/// `./distance@output`.
Computed make_utility(Builder& b, const std::vector<Given>& given, const std::string& program);

/// A transform of role `transform` whose world is `world` of the program; `rest` is what that gives
/// while everything rests (rig space).
NodeId make_result(Builder& b, const std::vector<Given>& given, const std::string& program,
                   const math::Affine& rest);

/// The parameter `names`: as many as `count`, each once, and words that programs take. Fails where
/// they do not fit.
const std::vector<std::string>& names_from(Builder& b, std::size_t count);
bool check_names(Builder& b, const std::vector<std::string>& names);

/// A number as programs read it back, bit for bit, in parentheses where it is negative.
std::string literal(double number);
/// `name + name + ...` of "name0", "name1", ...
std::string sum_of(const std::string& name, std::size_t count);

/// What a node is measured in where nobody says: the parent of a transform or joint.
NodeId space_or_parent(Builder& b, std::string_view parameter, NodeId node);
/// The world of a node that may be none (rig space).
Given world_given(std::string name, NodeId node);
math::Affine rest_or_identity(const Builder& b, NodeId node);

/// Connects a number to each of `to`, times `amounts` where they were given, on top of what the
/// plug rests at. Fails where the counts differ or a plug cannot take it.
void drive_plugs(Builder& b, const std::vector<Plug>& from, std::string_view to,
                 std::string_view amounts);

}  // namespace rigc::modules
