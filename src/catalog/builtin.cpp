// SPDX-License-Identifier: MIT
// Makes descriptors and shapes of the constant tables. Test: tests/catalog/catalogue_test.cpp
#include "catalog/builtin.h"

#include <cassert>

#include "base/json.h"

namespace rigc::catalog::builtin {
namespace {

std::optional<Literal> literal(std::string_view json) {
  if (json.empty()) return std::nullopt;
  Diagnostics diagnostics;
  const auto document = json::parse(std::string(json), "built-in", 0, diagnostics);
  assert(document);
  return literal_from(document->root());
}

Parameter make(const ParameterData& data) {
  Parameter parameter;
  parameter.name = data.name;
  parameter.type = data.type;
  parameter.frame = data.frame;
  parameter.title = data.title;
  parameter.help = data.help;
  parameter.kind = data.kind;
  parameter.unit = data.unit;
  parameter.required = data.required;
  parameter.is_signed = data.is_signed;
  parameter.values.assign(data.values.begin(), data.values.end());
  parameter.default_value = literal(data.default_json);
  parameter.min = data.min;
  parameter.max = data.max;
  return parameter;
}

Creates make(const CreatesData& data) {
  return {std::string(data.role), std::string(data.kind), std::string(data.per),
          std::string(data.help)};
}

Change make(const ChangeData& data) {
  return {data.version,
          std::string(data.parameter),
          std::string(data.was),
          literal(data.default_was_json),
          std::string(data.note),
          std::string(data.attribute),
          data.factor,
          data.offset,
          data.min_was,
          data.max_was};
}

}  // namespace

Descriptor make(const ModuleData& data) {
  Descriptor descriptor;
  descriptor.module = data.module;
  descriptor.version = data.version;
  descriptor.title = data.title;
  descriptor.category = data.category;
  descriptor.summary = data.summary;
  descriptor.help = data.help;
  descriptor.implementation = data.implementation;
  descriptor.example = data.example;
  descriptor.stage = data.stage;
  for (const ParameterData& parameter : data.parameters) {
    descriptor.parameters.push_back(make(parameter));
  }
  for (const CreatesData& made : data.creates) descriptor.creates.push_back(make(made));
  for (const ReplacesData& pair : data.replaces) {
    if (descriptor.replaces.empty() || descriptor.replaces.back().first != pair.module) {
      descriptor.replaces.emplace_back().first = pair.module;
    }
    descriptor.replaces.back().second.emplace_back(pair.before, pair.after);
  }
  for (const ChangeData& change : data.changes) descriptor.changes.push_back(make(change));
  return descriptor;
}

Shape make(const ShapeData& data) {
  Shape shape{std::string(data.name), std::string(data.help), {}};
  for (std::size_t at = 0; at < data.lines.size();) {
    auto& line = shape.lines.emplace_back(static_cast<std::size_t>(data.lines[at++]));
    for (Point& point : line) {
      for (double& coordinate : point) coordinate = data.lines[at++];
    }
  }
  return shape;
}

}  // namespace rigc::catalog::builtin
