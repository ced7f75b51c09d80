// SPDX-License-Identifier: MIT
// JSON Schema of parameters. Where several types are allowed they stand flat in one schema, whose
// limits hold for numbers and whose patterns for texts: editors then say what is wrong, and not
// that no alternative fits. Test: tests/pipeline/schema_test.cpp
#include "pipeline/schema_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "pipeline/reference.h"
#include "selector/pattern.h"

namespace rigc::pipeline {
namespace {

using catalog::Descriptor;
using catalog::Parameter;
using catalog::ParameterType;

/// A template in centimetres writes lengths a hundred times as large as the descriptor says.
constexpr double kCentimetres = 100;

class ValueWriter {
 public:
  ValueWriter(json::Writer& w, const Parameter& parameter, bool placeholders)
      : w_(w), parameter_(parameter), placeholders_(placeholders) {}
  void write();

 private:
  void number(const char* type);
  void boolean();
  void list_of_numbers(std::size_t count);
  void text();
  void selector(selector::Wanted wanted, bool several);
  void color();
  void words(const std::vector<std::string>& values);
  void curve();
  void texts();
  void table();
  void expression();
  void value();
  /// `type`, or also a text that is a placeholder and nothing else.
  void type_or_placeholder(const char* type, const char* message);
  void limits();
  void placeholder() {
    if (placeholders_) write_pattern(w_, kPlaceholderPattern, "expected `$parameter`");
  }

  json::Writer& w_;
  const Parameter& parameter_;
  bool placeholders_;
};

void ValueWriter::write() {
  switch (parameter_.type) {
    case ParameterType::number:
    case ParameterType::angle:
    case ParameterType::length:
      return number("number");
    case ParameterType::integer:
      return number("integer");
    case ParameterType::numbers:
      return list_of_numbers(0);
    case ParameterType::vec3:
      return list_of_numbers(3);
    case ParameterType::boolean:
      return boolean();
    case ParameterType::node:
      return selector(selector::Wanted::node, false);
    case ParameterType::nodes:
      return selector(selector::Wanted::node, true);
    case ParameterType::plug:
      return selector(selector::Wanted::plug, false);
    case ParameterType::plugs:
      return selector(selector::Wanted::plug, true);
    case ParameterType::color:
      return color();
    case ParameterType::enumeration:
      return words(parameter_.values);
    case ParameterType::text:
      return text();
    case ParameterType::curve:
      return curve();
    case ParameterType::texts:
      return texts();
    case ParameterType::table:
      return table();
    case ParameterType::expression:
      return expression();
    case ParameterType::value:
      return value();
  }
}

void ValueWriter::type_or_placeholder(const char* type, const char* message) {
  if (!placeholders_) return write_types(w_, {type});
  write_types(w_, {type, "string"});
  write_pattern(w_, kPlaceholderPattern, message);
}

void ValueWriter::limits() {
  const bool length = parameter_.type == ParameterType::length;
  if (parameter_.min)
    w_.member("minimum",
              length ? std::min(*parameter_.min, *parameter_.min * kCentimetres) : *parameter_.min);
  if (parameter_.max)
    w_.member("maximum",
              length ? std::max(*parameter_.max, *parameter_.max * kCentimetres) : *parameter_.max);
}

void ValueWriter::number(const char* type) {
  type_or_placeholder(type, *type == 'i' ? "expected an integer or `$parameter`"
                                         : "expected a number or `$parameter`");
  limits();
}

void ValueWriter::boolean() {
  write_types(w_, {"boolean", "string"});
  const std::string words = "on|off";
  if (placeholders_)
    write_pattern(w_, fmt::format("{}|{}", words, kPlaceholderPattern),
                  "expected true, false, on, off or `$parameter`");
  else
    write_pattern(w_, words, "expected true, false, on or off");
}

void ValueWriter::list_of_numbers(std::size_t count) {
  type_or_placeholder("array", "expected a list of numbers or `$parameter`");
  w_.key("items").begin_object();
  type_or_placeholder("number", "expected a number or `$parameter`");
  limits();
  w_.end_object();
  if (count > 0) w_.member("minItems", count).member("maxItems", count);
}

void ValueWriter::text() {
  write_types(w_, {"string"});
  w_.member("minLength", 1);
  if (parameter_.name != "local" && parameter_.name != "label") return;
  const std::string name(kNamePattern);
  write_pattern(w_, placeholders_ ? fmt::format(R"(\$?{})", name) : name,
                "a name has letters, digits, `_` and `-` and does not start with a digit or `-`");
}

void ValueWriter::selector(selector::Wanted wanted, bool several) {
  const bool plug = wanted == selector::Wanted::plug;
  std::string pattern = selector::pattern(wanted);
  if (placeholders_) pattern = fmt::format("^{}$|{}", kPlaceholderPattern, pattern);
  const auto one = [&] {
    w_.member("pattern", pattern);
    w_.member("patternErrorMessage",
              plug ? "expected a selector of an attribute, like `arm_l/control@size`"
                   : "expected a selector of a node, like `arm_l.elbow/control`");
  };
  if (!several) {
    write_types(w_, {"string"});
    return one();
  }
  write_types(w_, {"string", "array"});
  one();
  w_.key("items").begin_object();
  write_types(w_, {"string"});
  one();
  w_.end_object().member("minItems", 1);
}

void ValueWriter::color() {
  w_.key("anyOf").begin_array();
  w_.begin_object().key("enum").begin_array();
  for (const std::string& name : catalog::color_names()) w_.value(name);
  w_.end_array().end_object();
  w_.begin_object();
  type_or_placeholder("array", "expected a colour's name, [r, g, b] or `$parameter`");
  w_.key("items").begin_object();
  type_or_placeholder("number", "expected a number or `$parameter`");
  w_.member("minimum", 0).member("maximum", 1).end_object();
  w_.member("minItems", 3).member("maxItems", 3).end_object();
  w_.end_array();
}

void ValueWriter::words(const std::vector<std::string>& values) {
  const auto list = [&] {
    w_.key("enum").begin_array();
    for (const std::string& value : values) w_.value(value);
    w_.end_array();
  };
  if (!placeholders_) return list();
  w_.key("anyOf").begin_array().begin_object();
  list();
  w_.end_object().begin_object();
  write_types(w_, {"string"});
  placeholder();
  w_.end_object().end_array();
}

void ValueWriter::curve() {
  type_or_placeholder("array", "expected a list of points or `$parameter`");
  w_.member("minItems", 2).key("items").begin_object();
  type_or_placeholder("array", "expected a point or `$parameter`");
  w_.member("minItems", 2).member("maxItems", 3);
  w_.key("items").begin_object();
  write_types(w_, {"number", "string"});
  w_.end_object().end_object();
}

void ValueWriter::texts() {
  write_types(w_, {"array", "string"});
  w_.member("minItems", 1).key("items").begin_object();
  write_types(w_, {"string"});
  w_.end_object();
}

void ValueWriter::table() {
  type_or_placeholder("array", "expected a list of rows or `$parameter`");
  w_.member("minItems", 1).key("items").begin_object();
  type_or_placeholder("array", "expected a row of numbers or `$parameter`");
  w_.member("minItems", 1).key("items").begin_object();
  type_or_placeholder("number", "expected a number or `$parameter`");
  w_.end_object().end_object();
}

void ValueWriter::expression() {
  write_types(w_, {"number", "string"});
  write_pattern(w_, R"([^{}]+|[^{}]*(\{[^{}]+\}[^{}]*)+)",
                "expected an expression with selectors of attributes in braces");
}

void ValueWriter::value() {
  write_types(w_, {"number", "boolean", "string", "array"});
  w_.key("items").begin_object();
  type_or_placeholder("number", "expected a number or `$parameter`");
  w_.end_object().member("minItems", 3).member("maxItems", 3);
}

/// The help with what a value may be and what it is where none is given.
std::string description(const Parameter& parameter) {
  std::string text = fmt::format("{}\n\n`{}`", trim(parameter.help), type_text(parameter));
  const std::string value = default_text(parameter);
  if (parameter.required)
    text += ", required";
  else if (!value.empty())
    text += fmt::format(", default `{}`", value);
  return text;
}

void write_parameter(json::Writer& w, const std::string& name, const Parameter& parameter) {
  w.key(name).begin_object();
  if (!parameter.title.empty()) w.member("title", parameter.title);
  write_description(w, description(parameter));
  if (parameter.default_value) {
    w.key("default");
    write(w, *parameter.default_value);
  }
  if (name != parameter.name)
    w.member("deprecationMessage",
             fmt::format("`{}` is called `{}` now; a template that is pinned to an earlier version "
                         "of the module may keep it",
                         name, parameter.name));
  write_parameter_values(w, parameter, true);
  w.end_object();
}

/// Earlier names of a parameter, which templates that are pinned to those versions use.
std::vector<std::string> earlier_names(const Descriptor& descriptor, const Parameter& parameter) {
  std::vector<std::string> names;
  for (const catalog::Change& change : descriptor.changes)
    if (change.parameter == parameter.name && !change.was.empty()) names.push_back(change.was);
  return names;
}

/// Whether a template that is pinned to an earlier version may leave it out.
bool had_default(const Descriptor& descriptor, const Parameter& parameter) {
  return std::any_of(descriptor.changes.begin(), descriptor.changes.end(),
                     [&](const catalog::Change& change) {
                       return change.parameter == parameter.name && change.default_was;
                     });
}

void write_required(json::Writer& w, const Descriptor& descriptor) {
  w.key("required").begin_array();
  for (const Parameter& parameter : descriptor.parameters)
    if (parameter.required && earlier_names(descriptor, parameter).empty() &&
        !had_default(descriptor, parameter))
      w.value(parameter.name);
  w.end_array();
}

/// A template that is pinned to an earlier version writes numbers of that version's unit and range:
/// the editor does not know which counts.
Parameter without_stale_range(const Descriptor& descriptor, Parameter parameter) {
  for (const catalog::Change& change : descriptor.changes) {
    if (change.parameter != parameter.name) continue;
    const bool other_unit = change.factor != 1 || change.offset != 0;
    if (other_unit || change.min_was) parameter.min.reset();
    if (other_unit || change.max_was) parameter.max.reset();
  }
  return parameter;
}

}  // namespace

void write_types(json::Writer& w, std::initializer_list<const char*> types) {
  w.key("type");
  if (types.size() == 1) {
    w.value(*types.begin());
    return;
  }
  w.begin_array();
  for (const char* type : types) w.value(type);
  w.end_array();
}

void write_pattern(json::Writer& w, std::string_view pattern, std::string_view message) {
  w.member("pattern", fmt::format("^({})$", pattern)).member("patternErrorMessage", message);
}

void write_description(json::Writer& w, std::string_view markdown) {
  w.member("description", markdown).member("markdownDescription", markdown);
}

void write_parameter_values(json::Writer& w, const Parameter& parameter, bool placeholders) {
  ValueWriter(w, parameter, placeholders).write();
}

void write_arguments(json::Writer& w, const Descriptor& descriptor) {
  w.begin_object().member("title", descriptor.title);
  write_description(w, descriptor.summary);
  const bool required = std::any_of(descriptor.parameters.begin(), descriptor.parameters.end(),
                                    [](const Parameter& parameter) { return parameter.required; });
  if (required)
    write_types(w, {"object"});
  else
    write_types(w, {"object", "null"});
  w.member("additionalProperties", false).key("properties").begin_object();
  for (const Parameter& declared : descriptor.parameters) {
    const Parameter parameter = without_stale_range(descriptor, declared);
    write_parameter(w, parameter.name, parameter);
    for (const std::string& name : earlier_names(descriptor, parameter))
      if (!descriptor.find(name)) write_parameter(w, name, parameter);
  }
  if (descriptor.makes_nodes())
    for (const Parameter& parameter : catalog::creation_parameters())
      write_parameter(w, parameter.name, parameter);
  w.end_object();
  if (required) write_required(w, descriptor);
  w.end_object();
}

}  // namespace rigc::pipeline
