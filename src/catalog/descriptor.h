// SPDX-License-Identifier: MIT
// A module's descriptor as data: what modules.d/<module>.yaml says. The reader, the docs, the
// schema and editors use the same one. Test: tests/catalog/descriptor_test.cpp
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/literal.h"

namespace rigc::catalog {

/// Types of parameters; where the YAML name differs it stands behind.
// clang-format off
enum class ParameterType : std::uint8_t {
  node, nodes, plug, plugs, number /* float */, numbers /* floats */, integer /* int */,
  boolean /* bool */, angle, length, vec3, color, enumeration /* enum */, text /* string */,
  curve, expression, value /* what its plug takes: number, boolean, text or [x, y, z] */,
  texts /* strings */, table /* rows of as many numbers each */
};
// clang-format on

enum class Stage : std::uint8_t { build, connect, finish, optimize };

/// A parameter is required, has a default, or may be left out (`optional: true`: its help says what
/// then).
struct Parameter {
  std::string name;
  ParameterType type = ParameterType::number;
  std::string frame;  ///< heading above it in an editor
  std::string title;
  std::string help;
  bool required = false;
  std::string kind;  ///< node, nodes: the kind accepted ("joint", "control"); empty: any
  std::string unit;
  std::vector<std::string> values;  ///< of an enumeration
  std::optional<Literal> default_value;
  std::optional<double> min, max;
  /// `side: signed`: on a mirrored joint numbers change sign, vectors (character axes) their x, and
  /// `left` and `right`, `+x` and `-x` change places.
  bool is_signed = false;
  bool optional() const { return !required && !default_value; }
  bool operator==(const Parameter&) const = default;
};

struct Creates {
  std::string role;
  std::string kind;
  std::string per = "command";  ///< "command" or "joint"
  std::string help;
  bool operator==(const Creates&) const = default;
};

/// One entry of `changes:`: what a version changed in one parameter, or in one attribute that the
/// module puts on its controls. What it means: catalog/changes.h.
struct Change {
  int version = 0;
  std::string parameter;               ///< by its present name
  std::string was;                     ///< earlier name of the parameter or attribute
  std::optional<Literal> default_was;  ///< earlier default, as a command would have written it then
  std::string note;
  std::string attribute;  ///< by its present name; in place of `parameter`
  /// A number of the version before, as this version takes it: number * factor + offset.
  double factor = 1, offset = 0;
  std::optional<double> min_was, max_was;  ///< earlier range, as written then
  bool operator==(const Change&) const = default;
};

/// What modules.d/<module>.yaml says.
struct Descriptor {
  std::string module;
  int version = 1;
  std::string title, category, summary, help;
  std::string implementation =
      "builtin";  ///< or the name of another module, whose constructor runs
  Stage stage = Stage::build;
  std::vector<Parameter> parameters;
  std::vector<Creates> creates;
  std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>>
      replaces;  ///< module -> (role, role), or (role.attribute, number): see changes.h
  std::vector<Change> changes;
  std::string example;  ///< a whole small template (YAML) that the tests build
  const Parameter* find(std::string_view parameter) const;
  bool makes_nodes() const { return !creates.empty(); }
  bool operator==(const Descriptor&) const = default;
};

/// Reads one descriptor, checked completely against the schema of descriptors.
std::optional<Descriptor> read_descriptor(std::uint32_t file, Diagnostics& diagnostics);

/// Why a value cannot be an argument of a parameter.
struct Mismatch {
  Span span;
  std::string message;
  std::string hint;
};

/// Checks type, range and enumeration of an argument or a default; nothing if it fits. Selectors
/// and expressions are only checked to be texts.
std::optional<Mismatch> mismatch(const Parameter& parameter, const Literal& value);

/// `name`, `local`, `label`: what every command that makes nodes takes besides its descriptor's
/// parameters.
const std::vector<Parameter>& creation_parameters();
bool is_creation_parameter(std::string_view name);

/// The colours that have names, and what they are (sRGB, 0..1).
std::optional<std::array<double, 3>> named_color(std::string_view name);
std::vector<std::string> color_names();

std::string_view name_of(ParameterType type);  ///< as in YAML
std::optional<ParameterType> parse_type(std::string_view name);
std::string_view name_of(Stage stage);
std::optional<Stage> parse_stage(std::string_view name);

}  // namespace rigc::catalog
