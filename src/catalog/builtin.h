// SPDX-License-Identifier: MIT
// Built-in descriptors and shapes as constant tables: tools/embed.cpp writes them from modules.d/
// and shapes/, builtin.cpp makes descriptors of them when somebody asks. Nothing runs before main.
// Test: tests/catalog/catalogue_test.cpp
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "catalog/descriptor.h"
#include "catalog/shape.h"

namespace rigc::catalog::builtin {

struct ParameterData {
  std::string_view name;
  ParameterType type;
  std::string_view frame, title, help, kind, unit;
  bool required;
  bool is_signed;
  std::string_view default_json;  ///< empty: none
  std::optional<double> min, max;
  std::span<const std::string_view> values;
};

struct CreatesData {
  std::string_view role, kind, per, help;
};

struct ReplacesData {
  std::string_view module, before, after;  ///< one pair of roles
};

struct ChangeData {
  int version;
  std::string_view parameter, was, default_was_json, note, attribute;
  double factor, offset;
  std::optional<double> min_was, max_was;
};

struct ModuleData {
  std::string_view module;
  int version;
  std::string_view title, category, summary, help, implementation, example;
  Stage stage;
  std::span<const ParameterData> parameters;
  std::span<const CreatesData> creates;
  std::span<const ReplacesData> replaces;
  std::span<const ChangeData> changes;
};

struct ShapeData {
  std::string_view name, help;
  std::span<const double> lines;  ///< for each line: number of points, x, y, z, x, ...
};

/// Sorted by name; in the generated file.
std::span<const ModuleData> modules();
std::span<const ShapeData> shapes();

Descriptor make(const ModuleData& data);
Shape make(const ShapeData& data);

}  // namespace rigc::catalog::builtin
