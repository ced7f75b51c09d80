// SPDX-License-Identifier: MIT
// Arguments against declarations: of commands against descriptors, of parts against `parameters:`;
// and the values that `$name` stands for. Test: tests/templates/arguments_test.cpp
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "catalog/descriptor.h"
#include "templates/template.h"

namespace rigc::templates {

/// Values of a template's parameters, for one use of it.
using Environment = std::map<std::string, Literal, std::less<>>;

/// The name in a text `$name`; empty where the value is anything else.
std::string_view parameter_name(const Literal& value);

/// Replaces every `$name` inside by its value, which keeps the place of the `$name`. True if there
/// was any.
bool substitute(Literal& value, const Environment& environment);

/// Whether values are selectors: node, nodes, plug, plugs.
bool is_selector(catalog::ParameterType type);

/// Reports every `$name` inside that the template does not declare.
bool check_declared(const Literal& value, const Template& owner, Diagnostics& diagnostics);

/// The declaration of an argument: of the descriptor, or `name`, `local`, `label` where it makes
/// nodes.
const catalog::Parameter* declaration(const catalog::Descriptor& descriptor,
                                      std::string_view argument);

/// The version of a module that a template was written for: its pin, else the present one.
int pinned_version(const Template& owner, const catalog::Descriptor& descriptor);

/// Checks all arguments of a command as written. What was written for the pinned version (names,
/// units, ranges: `changes:`) becomes what the module takes now, lengths become metres. Values with
/// `$name` are converted and checked once they are known.
void check_arguments(const catalog::Descriptor& descriptor, const Template& owner,
                     tags::CommandTag& command, Diagnostics& diagnostics);

/// A value of an earlier version of the module as the present one takes it; a value of the earlier
/// range that lies outside of today's is reported.
void convert_value(const catalog::Descriptor& descriptor, const catalog::Parameter& parameter,
                   int version, Literal& value, Diagnostics& diagnostics);

/// Writes out what a command of an earlier version leaves to defaults that are others now.
void add_earlier_defaults(const catalog::Descriptor& descriptor, int version,
                          tags::CommandTag& command);

/// A command that was written for an earlier version of its module (and expanded: without `$name`)
/// as the present version takes it: names, units, ranges, defaults. A parameter that is gone is
/// reported and left out. False where a value no longer fits, which is an error.
bool upgrade(const catalog::Descriptor& descriptor, int version, tags::CommandTag& command,
             Diagnostics& diagnostics);

/// Type, range, choice, selector and expression syntax of one value.
bool check_value(const catalog::Parameter& parameter, const Literal& value,
                 Diagnostics& diagnostics);

/// Lengths, and vectors in metres, from the file's unit.
void to_metres(const catalog::Parameter& parameter, double metres_per_unit, Literal& value);

bool holds(const Condition& condition, const Environment& environment);

}  // namespace rigc::templates
