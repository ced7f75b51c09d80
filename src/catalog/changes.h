// SPDX-License-Identifier: MIT
// What `changes:` and `replaces:` of a descriptor mean for what earlier versions left behind:
// arguments of commands, keys on attributes of controls, roles of nodes. A version is always one
// that came before; each answer is in terms of the descriptor's own, the present one.
// Test: tests/catalog/changes_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/descriptor.h"

namespace rigc::catalog {

/// The parameter that a command of a version means by a name: one that was called so then, else one
/// that is called so now. Null: there is none.
const Parameter* parameter_at(const Descriptor& descriptor, int version, std::string_view name);

/// A value of a parameter as a version took it, converted in place: every number in it by the
/// factors and offsets since, an expression by arithmetic around it. True where a value of the
/// earlier range lay outside of today's and became its nearest end. What fits no range stays as it
/// is: mismatch() tells.
bool convert(const Descriptor& descriptor, const Parameter& parameter, int version, Literal& value);

/// The value that a parameter had in a version where a command left it out, if that is not what it
/// has now.
std::optional<Literal> default_at(const Descriptor& descriptor, const Parameter& parameter,
                                  int version);

/// An attribute of the module's controls that had another name or unit in a version.
struct AttributeChange {
  std::string was, name;
  double factor = 1, offset = 0;  ///< value now = value then * factor + offset; slopes * factor
  bool operator==(const AttributeChange&) const = default;
};
/// Those that are not what they were, in the order of `changes:`.
std::vector<AttributeChange> attribute_changes(const Descriptor& descriptor, int version);

/// The role that stands for another module's role where this module has succeeded it.
std::optional<std::string> replaced_role(const Descriptor& descriptor, std::string_view module,
                                         std::string_view role);

/// An attribute of a module's controls in one role, and a number for it.
struct AttributeValue {
  std::string role, attribute;
  double value = 0;
  bool operator==(const AttributeValue&) const = default;
};
/// Those with which this module does what the module did that it succeeds: in `replaces:`
/// `settings.ik_fk: 0`.
std::vector<AttributeValue> values_as(const Descriptor& descriptor, std::string_view module);

/// One change in words, for people: `version 3: blend was called ik_fk`.
std::string describe(const Change& change);

}  // namespace rigc::catalog
