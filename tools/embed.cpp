// SPDX-License-Identifier: MIT
// A build step: reads descriptors (modules.d/) and shapes (shapes/) and writes them as one C++ file
// of constant tables (src/catalog/builtin.h). A wrong descriptor fails the build with its
// diagnostics. rigc_embed OUT.cpp DESCRIPTOR... --shapes SHAPES...      Test:
// tests/catalog/catalogue_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "base/files.h"
#include "base/json.h"
#include "base/text.h"
#include "base/yaml.h"
#include "catalog/codes.h"
#include "catalog/descriptor.h"
#include "catalog/shape.h"

namespace {

using namespace rigc;
using namespace rigc::catalog;

constexpr std::uint64_t kLargestFile = 4u << 20;
constexpr std::size_t kNumbersPerLine = 12;

/// A C++ string literal, one source line for each line of text; other bytes than ASCII as octal
/// escapes.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') {
      out += i + 1 < text.size() ? "\\n\"\n    \"" : "\\n";
    } else if (c == '"' || c == '\\') {
      out.append("\\").append(1, c);
    } else if (c >= ' ' && c <= '~') {
      out += c;
    } else {
      out += fmt::format("\\{:03o}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
  }
  return out + "\"";
}

/// A name as part of an identifier.
std::string identifier(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string json_of(const std::optional<Literal>& literal) {
  if (!literal) return "\"\"";
  json::Writer writer;
  write(writer, *literal);
  return quoted(writer.text());
}

/// Numbers are written so that C++ reads doubles: 1 as 1., 1e-05 as it stands.
std::string double_text(double number) {
  std::string text = number_text(number);
  if (text.find_first_of(".eE") == std::string::npos) text += '.';
  return text;
}

/// A constant array, or nothing where there are no items; its name, or `{}`.
class Tables {
 public:
  std::string add(std::string_view type, const std::string& name,
                  const std::vector<std::string>& items) {
    if (items.empty()) return "{}";
    out_ += fmt::format("constexpr {} {}[] = {{\n", type, name);
    for (const std::string& item : items) out_ += "    " + item + ",\n";
    out_ += "};\n";
    return name;
  }
  const std::string& text() const { return out_; }

 private:
  std::string out_;
};

std::string bound(const std::optional<double>& number) {
  return number ? double_text(*number) : std::string("std::nullopt");
}

std::string change_row(const Change& change) {
  return fmt::format("{{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}}", change.version,
                     quoted(change.parameter), quoted(change.was), json_of(change.default_was),
                     quoted(change.note), quoted(change.attribute), double_text(change.factor),
                     double_text(change.offset), bound(change.min_was), bound(change.max_was));
}

std::string parameter_row(const Parameter& parameter, const std::string& prefix, Tables& tables) {
  std::vector<std::string> values;
  for (const std::string& value : parameter.values) values.push_back(quoted(value));
  const std::string list =
      tables.add("std::string_view", prefix + identifier(parameter.name), values);
  return fmt::format(
      "{{{}, static_cast<ParameterType>({}), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}}",
      quoted(parameter.name), static_cast<int>(parameter.type), quoted(parameter.frame),
      quoted(parameter.title), quoted(parameter.help), quoted(parameter.kind),
      quoted(parameter.unit), parameter.required, parameter.is_signed,
      json_of(parameter.default_value), bound(parameter.min), bound(parameter.max), list);
}

std::string module_row(const Descriptor& module, Tables& tables) {
  const std::string prefix = "k_" + identifier(module.module) + "_";
  std::vector<std::string> parameters, creates, replaces, changes;
  for (const Parameter& parameter : module.parameters) {
    parameters.push_back(parameter_row(parameter, prefix + "values_", tables));
  }
  for (const Creates& made : module.creates) {
    creates.push_back(fmt::format("{{{}, {}, {}, {}}}", quoted(made.role), quoted(made.kind),
                                  quoted(made.per), quoted(made.help)));
  }
  for (const auto& [earlier, roles] : module.replaces) {
    for (const auto& [before, after] : roles) {
      replaces.push_back(
          fmt::format("{{{}, {}, {}}}", quoted(earlier), quoted(before), quoted(after)));
    }
  }
  for (const Change& change : module.changes) changes.push_back(change_row(change));
  const std::string parameter_list = tables.add("ParameterData", prefix + "parameters", parameters);
  const std::string creates_list = tables.add("CreatesData", prefix + "creates", creates);
  const std::string replaces_list = tables.add("ReplacesData", prefix + "replaces", replaces);
  const std::string changes_list = tables.add("ChangeData", prefix + "changes", changes);
  return fmt::format("{{{}, {}, {}, {}, {}, {}, {}, {}, static_cast<Stage>({}), {}, {}, {}, {}}}",
                     quoted(module.module), module.version, quoted(module.title),
                     quoted(module.category), quoted(module.summary), quoted(module.help),
                     quoted(module.implementation), quoted(module.example),
                     static_cast<int>(module.stage), parameter_list, creates_list, replaces_list,
                     changes_list);
}

std::string shape_row(const Shape& shape, Tables& tables) {
  std::vector<std::string> numbers, rows;
  for (const auto& line : shape.lines) {
    numbers.push_back(double_text(static_cast<double>(line.size())));
    for (const Point& point : line) {
      for (double coordinate : point) numbers.push_back(double_text(coordinate));
    }
  }
  for (std::size_t at = 0; at < numbers.size(); at += kNumbersPerLine) {
    const std::size_t end = std::min(at + kNumbersPerLine, numbers.size());
    const auto begin = numbers.begin();
    rows.push_back(join({begin + static_cast<long>(at), begin + static_cast<long>(end)}, ", "));
  }
  const std::string list = tables.add("double", "k_shape_" + identifier(shape.name), rows);
  return fmt::format("{{{}, {}, {}}}", quoted(shape.name), quoted(shape.help), list);
}

std::string generate(std::vector<Descriptor> modules, std::vector<Shape> shapes) {
  std::sort(modules.begin(), modules.end(),
            [](const Descriptor& a, const Descriptor& b) { return a.module < b.module; });
  std::sort(shapes.begin(), shapes.end(),
            [](const Shape& a, const Shape& b) { return a.name < b.name; });
  Tables tables;
  std::vector<std::string> module_rows, shape_rows;
  for (const Descriptor& module : modules) module_rows.push_back(module_row(module, tables));
  for (const Shape& shape : shapes) shape_rows.push_back(shape_row(shape, tables));
  const std::string module_list = tables.add("ModuleData", "kModules", module_rows);
  const std::string shape_list = tables.add("ShapeData", "kShapes", shape_rows);
  return "// Made by rigc_embed from modules.d/ and shapes/. Do not edit.\n"
         "#include \"catalog/builtin.h\"\n\nnamespace rigc::catalog::builtin {\nnamespace {\n\n" +
         tables.text() +
         "\n}  // namespace\n\n"
         "std::span<const ModuleData> modules() { return " +
         module_list +
         "; }\n"
         "std::span<const ShapeData> shapes() { return " +
         shape_list +
         "; }\n\n"
         "}  // namespace rigc::catalog::builtin\n";
}

/// Registers a file's text as a source; 0 where it cannot be read.
std::uint32_t open(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_file(path, kLargestFile, diagnostics);
  return text ? diagnostics.sources().add(path, std::move(*text)) : 0;
}

void read_module(const std::string& path, std::vector<Descriptor>& modules,
                 Diagnostics& diagnostics) {
  const std::uint32_t file = open(path, diagnostics);
  if (file == 0) return;
  if (auto module = read_descriptor(file, diagnostics)) modules.push_back(std::move(*module));
}

void read_shape_file(const std::string& path, std::vector<Shape>& all, Diagnostics& diagnostics) {
  const std::uint32_t file = open(path, diagnostics);
  if (file == 0) return;
  const auto root = yaml::read(file, diagnostics);
  if (!root) return;
  auto shapes = read_shapes(*root, diagnostics);
  if (!shapes) return;
  for (Shape& shape : *shapes) {
    const auto same = [&](const Shape& other) { return other.name == shape.name; };
    if (std::any_of(all.begin(), all.end(), same)) {
      diagnostics.report(catalog::codes::kDuplicateShape, root->find_entry(shape.name)->key_span,
                         fmt::format("shape {} stands in another file too", shape.name));
    }
    all.push_back(std::move(shape));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty()) return 2;
  Diagnostics diagnostics;
  std::vector<Descriptor> modules;
  std::vector<Shape> shapes;
  bool in_shapes = false;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i] == "--shapes") {
      in_shapes = true;
    } else if (in_shapes) {
      read_shape_file(arguments[i], shapes, diagnostics);
    } else {
      read_module(arguments[i], modules, diagnostics);
    }
  }
  if (diagnostics.ok()) {
    write_file(arguments[0], {generate(std::move(modules), std::move(shapes))}, diagnostics);
  }
  std::fputs(render(diagnostics, false).c_str(), stderr);
  return diagnostics.ok() ? 0 : 1;
}
