// SPDX-License-Identifier: MIT
// Reads what a template declares: parameters, the catalogue of features, module pins.
// Test: tests/templates/read_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "templates/arguments.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/reader.h"

namespace rigc::templates {
namespace {

using catalog::Parameter;
using catalog::ParameterType;

std::optional<ParameterType> read_type(Reader& reader, const yaml::Node& node) {
  const auto text = yaml::as_text(node, "type", reader.diagnostics);
  if (!text) return std::nullopt;
  const std::vector<std::string>& types = parameter_format().words("type");
  if (std::count(types.begin(), types.end(), *text) != 0) return catalog::parse_type(*text);
  reader.error(codes::kUnknownWord, node.span,
               fmt::format("type: \"{}\" is no type of a parameter", printable(*text, 60)),
               suggest(*text, types));
  return std::nullopt;
}

void read_default(Reader& reader, const yaml::Node& node, Parameter& parameter) {
  const yaml::Node* value = node.find("default");
  if (!value) {
    parameter.required = true;
    return;
  }
  auto literal = literal_from(*value, reader.diagnostics);
  if (!literal) return;
  if (const auto mismatch = catalog::mismatch(parameter, *literal)) {
    reader.error(codes::kBadParameter, mismatch->span, mismatch->message, mismatch->hint);
    return;
  }
  to_metres(parameter, reader.out.metres_per_unit, *literal);
  parameter.default_value = std::move(literal);
}

void read_limits(Reader& reader, const yaml::Node& node, Parameter& parameter) {
  if (const yaml::Node* limit = node.find("min"))
    parameter.min = yaml::as_number(*limit, "min", reader.diagnostics);
  if (const yaml::Node* limit = node.find("max"))
    parameter.max = yaml::as_number(*limit, "max", reader.diagnostics);
  if (parameter.min && parameter.max && *parameter.min > *parameter.max)
    reader.error(codes::kBadParameter, node.find("max")->span, "max is below min");
}

void read_parameter(Reader& reader, const yaml::Node::Entry& entry) {
  const std::string what = fmt::format("the parameter {}", printable(entry.key, 60));
  if (!is_name(entry.key))
    reader.error(codes::kNotAllowed, entry.key_span,
                 fmt::format("\"{}\" is not a name", printable(entry.key, 60)));
  const yaml::Node& node = entry.value;
  if (!yaml::check_section(node, parameter_format(), what, reader.diagnostics)) return;
  Parameter parameter;
  parameter.name = entry.key;
  const yaml::Node* type_node = reader.required(node, "type", what);
  const auto type = type_node ? read_type(reader, *type_node) : std::nullopt;
  if (!type) return;
  parameter.type = *type;
  if (const yaml::Node* values = node.find("values"))
    parameter.values = reader.names(*values, "values");
  if (parameter.type == ParameterType::enumeration && parameter.values.empty()) {
    reader.error(codes::kBadParameter, type_node->span, "an enum lists its `values:`");
    return;
  }
  if (const yaml::Node* help = node.find("help"))
    parameter.help = yaml::as_text(*help, "help", reader.diagnostics).value_or("");
  read_limits(reader, node, parameter);
  read_default(reader, node, parameter);
  reader.out.parameters.push_back(std::move(parameter));
}

void read_feature(Reader& reader, const yaml::Node::Entry& entry) {
  const yaml::Node& node = entry.value;
  const std::string what = fmt::format("the feature {}", printable(entry.key, 60));
  if (!is_name(entry.key))
    reader.error(codes::kNotAllowed, entry.key_span,
                 fmt::format("\"{}\" is not a name", printable(entry.key, 60)));
  tags::FeatureDeclaration feature;
  feature.name = entry.key;
  if (!node.is_null()) {
    if (!yaml::check_section(node, feature_declaration_format(), what, reader.diagnostics)) return;
    if (const yaml::Node* kind = node.find("kind"))
      feature.kind = yaml::as_name(*kind, "kind", reader.diagnostics).value_or("");
    if (const yaml::Node* title = node.find("title"))
      feature.title = yaml::as_text(*title, "title", reader.diagnostics).value_or("");
    if (const yaml::Node* help = node.find("help"))
      feature.help = yaml::as_text(*help, "help", reader.diagnostics).value_or("");
    if (const yaml::Node* on = node.find("default"))
      feature.on = yaml::as_bool(*on, "default", reader.diagnostics).value_or(true);
    if (const yaml::Node* switches = node.find("switches"))
      feature.switches = reader.names(*switches, "switches");
  }
  reader.out.features.push_back(std::move(feature));
}

}  // namespace

void read_parameters(Reader& reader, const yaml::Node& node) {
  if (!node.is_map()) {
    yaml::check_keys(node, {}, "parameters", reader.diagnostics);
    return;
  }
  if (!reader.at_most(node, 256, "parameters")) return;
  for (const yaml::Node::Entry& entry : node.entries) read_parameter(reader, entry);
}

void read_features(Reader& reader, const yaml::Node& node) {
  if (!node.is_map()) {
    yaml::check_keys(node, {}, "features", reader.diagnostics);
    return;
  }
  reader.out.has_catalogue = true;
  if (!reader.at_most(node, 256, "features")) return;
  for (const yaml::Node::Entry& entry : node.entries) read_feature(reader, entry);
}

void read_groups(Reader& reader, const yaml::Node& node) {
  if (!node.is_map()) {
    yaml::check_keys(node, {}, "groups", reader.diagnostics);
    return;
  }
  if (!reader.at_most(node, 16384, "groups")) return;
  for (const yaml::Node::Entry& entry : node.entries) {
    const auto above = yaml::as_name(entry.value, entry.key, reader.diagnostics);
    if (above) reader.out.groups.emplace_back(entry.key, *above);
  }
}

void read_pins(Reader& reader, const yaml::Node& node) {
  if (!node.is_map()) {
    yaml::check_keys(node, {}, "modules", reader.diagnostics);
    return;
  }
  if (!reader.at_most(node, 1024, "modules")) return;
  for (const yaml::Node::Entry& entry : node.entries) {
    const catalog::Descriptor* descriptor = reader.catalogue.find(entry.key);
    if (!descriptor) {
      reader.error(codes::kUnknownModule, entry.key_span,
                   fmt::format("there is no module \"{}\"", printable(entry.key, 60)),
                   suggest(entry.key, reader.catalogue.modules()));
      continue;
    }
    const auto version = yaml::as_integer(entry.value, "version", reader.diagnostics);
    if (!version) continue;
    if (*version < 1 || *version > descriptor->version) {
      reader.error(codes::kModuleVersion, entry.value.span,
                   fmt::format("{} has no version {}", entry.key, *version),
                   fmt::format("this program has version {}", descriptor->version));
      continue;
    }
    reader.out.module_pins.emplace_back(entry.key, static_cast<int>(*version));
  }
}

}  // namespace rigc::templates
