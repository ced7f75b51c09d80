// SPDX-License-Identifier: MIT
// The words of descriptors: parameter types, stages, colours, and the parameters that all makers of
// nodes share. Test: tests/catalog/words_test.cpp
#include <algorithm>
#include <span>

#include "catalog/descriptor.h"
#include "catalog/reader.h"

namespace rigc::catalog {
namespace {

constexpr std::string_view kTypeNames[] = {
    "node", "nodes", "plug", "plugs",  "float", "floats",     "int",   "bool",    "angle", "length",
    "vec3", "color", "enum", "string", "curve", "expression", "value", "strings", "table"};
static_assert(std::size(kTypeNames) == static_cast<std::size_t>(ParameterType::table) + 1);

constexpr std::string_view kStageNames[] = {"build", "connect", "finish", "optimize"};

struct NamedColor {
  std::string_view name;
  std::array<double, 3> rgb;
};

// Bright enough to be told apart from a character and from each other.
constexpr NamedColor kColors[] = {
    {"red", {0.9, 0.15, 0.15}},   {"yellow", {0.95, 0.8, 0.1}}, {"blue", {0.15, 0.4, 0.95}},
    {"green", {0.2, 0.75, 0.25}}, {"orange", {0.95, 0.5, 0.1}}, {"purple", {0.55, 0.25, 0.85}},
    {"cyan", {0.1, 0.8, 0.85}},   {"pink", {0.95, 0.45, 0.7}},  {"white", {1, 1, 1}},
    {"grey", {0.5, 0.5, 0.5}},    {"black", {0, 0, 0}},         {"brown", {0.5, 0.3, 0.15}}};

std::vector<std::string> strings(std::span<const std::string_view> words) {
  return {words.begin(), words.end()};
}

}  // namespace

std::string_view name_of(ParameterType type) { return kTypeNames[static_cast<std::size_t>(type)]; }

std::string_view name_of(Stage stage) { return kStageNames[static_cast<std::size_t>(stage)]; }

std::vector<std::string> type_names() { return strings(kTypeNames); }

std::vector<std::string> stage_names() { return strings(kStageNames); }

std::optional<ParameterType> parse_type(std::string_view name) {
  const auto* found = std::find(std::begin(kTypeNames), std::end(kTypeNames), name);
  if (found == std::end(kTypeNames)) return std::nullopt;
  return static_cast<ParameterType>(found - std::begin(kTypeNames));
}

std::optional<Stage> parse_stage(std::string_view name) {
  const auto* found = std::find(std::begin(kStageNames), std::end(kStageNames), name);
  if (found == std::end(kStageNames)) return std::nullopt;
  return static_cast<Stage>(found - std::begin(kStageNames));
}

std::optional<std::array<double, 3>> named_color(std::string_view name) {
  for (const NamedColor& color : kColors) {
    if (color.name == name) return color.rgb;
  }
  return std::nullopt;
}

std::vector<std::string> color_names() {
  std::vector<std::string> names;
  for (const NamedColor& color : kColors) names.emplace_back(color.name);
  return names;
}

const std::vector<Parameter>& creation_parameters() {
  static const std::vector<Parameter> kParameters = [] {
    std::vector<Parameter> parameters(3);
    const char* const names[] = {"name", "local", "label"};
    const char* const helps[] = {
        "Name of what it makes, for people (default: from its joint and role).",
        "Local group of what it makes (default: its joint's).",
        "Label of what it makes (default: its joint's)."};
    for (std::size_t i = 0; i < 3; ++i) {
      parameters[i].name = names[i];
      parameters[i].type = ParameterType::text;
      parameters[i].help = helps[i];
    }
    return parameters;
  }();
  return kParameters;
}

bool is_creation_parameter(std::string_view name) {
  const std::vector<Parameter>& all = creation_parameters();
  return std::any_of(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
}

const Parameter* Descriptor::find(std::string_view parameter) const {
  for (const Parameter& candidate : parameters) {
    if (candidate.name == parameter) return &candidate;
  }
  return nullptr;
}

}  // namespace rigc::catalog
