// SPDX-License-Identifier: MIT
// Reads `parameters:` of a descriptor: frames and parameters in the order in which editors show
// them. Test: tests/catalog/descriptor_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "catalog/codes.h"
#include "catalog/format.h"
#include "catalog/reader.h"

namespace rigc::catalog {
namespace {

bool has_range(ParameterType type) {
  return type == ParameterType::number || type == ParameterType::numbers ||
         type == ParameterType::integer || type == ParameterType::angle ||
         type == ParameterType::length;
}

bool suits(std::string_view key, ParameterType type) {
  if (key == "kind") return type == ParameterType::node || type == ParameterType::nodes;
  if (key == "values") return type == ParameterType::enumeration;
  if (key == "min" || key == "max") return has_range(type);
  if (key == "unit") return has_range(type) || type == ParameterType::vec3;
  if (key == "side") {
    return has_range(type) || type == ParameterType::vec3 || type == ParameterType::enumeration;
  }
  return true;
}

/// `pole_distance` as `Pole distance`, `ik_size` as `IK size`.
std::string title_from(std::string_view name) {
  std::vector<std::string> words;
  for (std::string_view word : split(name, '_')) {
    words.emplace_back(word == "ik" ? "IK" : word == "fk" ? "FK" : word);
  }
  std::string title = join(words, " ");
  if (!title.empty() && title[0] >= 'a' && title[0] <= 'z') {
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
  }
  return title;
}

class ParameterReader {
 public:
  ParameterReader(const yaml::Node& node, Diagnostics& diagnostics)
      : node_(node), diagnostics_(diagnostics) {}

  std::optional<Parameter> read(const std::string& frame);

 private:
  void read_values(Parameter& parameter);
  void read_quantity(Parameter& parameter);
  void read_presence(Parameter& parameter);
  bool flag(std::string_view key);
  void report(const Code& code, const Span& span, std::string_view name, std::string_view message,
              std::string hint = {}) {
    diagnostics_.report(code, span, fmt::format("parameter {}: {}", name, message),
                        std::move(hint));
  }

  const yaml::Node& node_;
  Diagnostics& diagnostics_;
};

std::optional<Parameter> ParameterReader::read(const std::string& frame) {
  const std::size_t errors = diagnostics_.errors();
  if (!yaml::check_section(node_, parameter_format(), diagnostics_) && !node_.is_map()) return {};
  Parameter parameter;
  parameter.frame = frame;
  parameter.name = need_name(node_, "name", "parameter", diagnostics_);
  parameter.title = text_of(node_, "title", diagnostics_);
  if (parameter.title.empty()) parameter.title = title_from(parameter.name);
  parameter.help = need_text(node_, "help", "parameter", diagnostics_);
  const yaml::Node* type = need(node_, "type", "parameter", diagnostics_);
  if (!type) return {};
  const std::string word = word_of(*type, type_names(), "type", diagnostics_);
  if (word.empty()) return {};
  parameter.type = *parse_type(word);
  for (const yaml::Node::Entry& entry : node_.entries) {
    if (suits(entry.key, parameter.type)) continue;
    report(codes::kWrongKeyForType, entry.key_span, parameter.name,
           fmt::format("`{}` does not suit the type {}", entry.key, word));
  }
  if (const yaml::Node* kind = node_.find("kind")) {
    parameter.kind = yaml::as_name(*kind, "kind", diagnostics_).value_or("");
  }
  read_values(parameter);
  read_quantity(parameter);
  if (diagnostics_.errors() == errors) read_presence(parameter);
  if (diagnostics_.errors() != errors) return {};
  return parameter;
}

void ParameterReader::read_values(Parameter& parameter) {
  if (parameter.type != ParameterType::enumeration) return;
  const std::size_t errors = diagnostics_.errors();
  if (!need(node_, "values", "parameter", diagnostics_)) return;
  for (const yaml::Node& value : list_of(node_, "values", diagnostics_)) {
    const auto word = literal_from(value, diagnostics_);
    if (!word) continue;
    if (word->kind != Literal::Kind::text || word->text.empty()) {
      report(codes::kBadValues, value.span, parameter.name, "a value of an enum must be a word",
             "numbers and on, off, true, false are read as values of other types");
    } else if (std::count(parameter.values.begin(), parameter.values.end(), word->text) != 0) {
      report(codes::kBadValues, value.span, parameter.name,
             fmt::format("\"{}\" is listed twice", printable(word->text)));
    } else {
      parameter.values.push_back(word->text);
    }
  }
  if (parameter.values.size() < 2 && diagnostics_.errors() == errors) {
    report(codes::kBadValues, node_.find("values")->span, parameter.name,
           "an enum needs at least two values");
  }
}

void ParameterReader::read_quantity(Parameter& parameter) {
  parameter.unit = text_of(node_, "unit", diagnostics_);
  if (const yaml::Node* min = node_.find("min")) {
    parameter.min = yaml::as_number(*min, "min", diagnostics_);
  }
  if (const yaml::Node* max = node_.find("max")) {
    parameter.max = yaml::as_number(*max, "max", diagnostics_);
    if (parameter.min && parameter.max && *parameter.min > *parameter.max) {
      report(codes::kBadRange, max->span, parameter.name,
             fmt::format("min {} is above max {}", number_text(*parameter.min),
                         number_text(*parameter.max)));
    }
  }
  if (const yaml::Node* side = node_.find("side")) {
    parameter.is_signed = !word_of(*side, {"signed"}, "side", diagnostics_).empty();
  }
}

bool ParameterReader::flag(std::string_view key) {
  const yaml::Node* node = node_.find(key);
  return node && yaml::as_bool(*node, key, diagnostics_).value_or(false);
}

void ParameterReader::read_presence(Parameter& parameter) {
  const std::size_t errors = diagnostics_.errors();
  parameter.required = flag("required");
  const bool optional = flag("optional");
  const yaml::Node* default_node = node_.find("default");
  if (diagnostics_.errors() != errors) return;
  if (int{parameter.required} + int{optional} + int{default_node != nullptr} != 1) {
    report(codes::kPresence, node_.span, parameter.name,
           "needs exactly one of `required: true`, `default` and `optional: true`");
    return;
  }
  if (!default_node) return;
  parameter.default_value = literal_from(*default_node, diagnostics_);
  if (!parameter.default_value) return;
  if (const auto wrong = mismatch(parameter, *parameter.default_value)) {
    diagnostics_.report(codes::kBadDefault, wrong->span, "default of " + wrong->message,
                        wrong->hint);
  }
}

void read_frame(const yaml::Node& item, std::string& frame, std::vector<std::string>& frames,
                Diagnostics& diagnostics) {
  yaml::check_section(item, frame_format(), diagnostics);
  frame = need_text(item, "frame", "frame", diagnostics);
  if (std::count(frames.begin(), frames.end(), frame) != 0) {
    diagnostics.report(codes::kDuplicateFrame, item.span,
                       fmt::format("frame \"{}\" is opened twice", printable(frame)));
  }
  frames.push_back(frame);
}

}  // namespace

void read_parameters(const yaml::Node& map, Descriptor& descriptor, Diagnostics& diagnostics) {
  std::string frame;
  std::vector<std::string> frames;
  for (const yaml::Node& item : list_of(map, "parameters", diagnostics)) {
    if (item.is_map() && item.find("frame")) {
      read_frame(item, frame, frames, diagnostics);
      continue;
    }
    auto parameter = ParameterReader(item, diagnostics).read(frame);
    if (!parameter) continue;
    if (descriptor.find(parameter->name)) {
      diagnostics.report(codes::kDuplicateParameter, item.span,
                         fmt::format("parameter {} is declared twice", parameter->name));
    }
    if (is_creation_parameter(parameter->name) && map.find("creates")) {
      diagnostics.report(codes::kReservedParameter, item.span,
                         fmt::format("parameter {}: every command that makes nodes has it already",
                                     parameter->name));
    }
    descriptor.parameters.push_back(std::move(*parameter));
  }
}

}  // namespace rigc::catalog
