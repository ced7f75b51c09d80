// SPDX-License-Identifier: MIT
// The typed readers of YAML nodes: each reports a mismatch at the node's place.
// Test: tests/base/yaml_values_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/codes.h"
#include "base/text.h"
#include "base/yaml.h"

namespace rigc::yaml {
namespace {

/// What a node is, for "expected a number, not ...".
std::string found(const Node& node) {
  switch (node.kind) {
    case NodeKind::null:
      return "nothing";
    case NodeKind::sequence:
      return "a list";
    case NodeKind::map:
      return "a map";
    case NodeKind::scalar:
      break;
  }
  return fmt::format("{}\"{}\"", node.quoted ? "the text " : "", printable(node.text, 60));
}

void report_mismatch(const Code& code, const Node& node, std::string_view what, const char* wanted,
                     Diagnostics& diagnostics, std::string hint = {}) {
  diagnostics.report(code, node.span,
                     fmt::format("{}: expected {}, not {}", what, wanted, found(node)),
                     std::move(hint));
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string boolean_hint(const Node& node) {
  if (!node.is_scalar()) return {};
  const std::string word = lower(node.text);
  const auto is = [&](std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (is({"yes", "y", "no", "n"})) return "write true or false (or on/off)";
  if (!is({"true", "false", "on", "off"})) return {};
  return node.quoted ? "remove the quotes" : "write it in lower case";
}

std::string number_hint(const Node& node) {
  if (node.is_scalar() && node.quoted && parse_number(node.text)) return "remove the quotes";
  if (node.is_scalar() && node.text.find(',') != std::string::npos)
    return "write a point, not a comma, before the decimals";
  return {};
}

}  // namespace

std::optional<double> as_number(const Node& node, std::string_view what, Diagnostics& diagnostics) {
  if (node.is_scalar() && !node.quoted)
    if (const auto number = parse_number(node.text)) return number;
  report_mismatch(codes::kNotANumber, node, what, "a number", diagnostics, number_hint(node));
  return std::nullopt;
}

std::optional<long long> as_integer(const Node& node, std::string_view what,
                                    Diagnostics& diagnostics) {
  if (node.is_scalar() && !node.quoted)
    if (const auto number = parse_integer(node.text)) return number;
  report_mismatch(codes::kNotAnInteger, node, what, "an integer", diagnostics,
                  node.quoted ? number_hint(node) : "");
  return std::nullopt;
}

std::optional<bool> as_bool(const Node& node, std::string_view what, Diagnostics& diagnostics) {
  if (node.is_scalar() && !node.quoted) {
    if (node.text == "true" || node.text == "on") return true;
    if (node.text == "false" || node.text == "off") return false;
  }
  report_mismatch(codes::kNotABoolean, node, what, "true or false", diagnostics,
                  boolean_hint(node));
  return std::nullopt;
}

std::optional<std::string> as_text(const Node& node, std::string_view what,
                                   Diagnostics& diagnostics) {
  if (node.is_scalar()) return node.text;
  report_mismatch(codes::kNotText, node, what, "text", diagnostics);
  return std::nullopt;
}

std::optional<std::string> as_name(const Node& node, std::string_view what,
                                   Diagnostics& diagnostics) {
  if (node.is_scalar() && is_name(node.text)) return node.text;
  report_mismatch(codes::kNotAName, node, what, "a name", diagnostics,
                  "names have letters, digits, `_` and `-`, and do not start with a digit or `-`");
  return std::nullopt;
}

std::optional<std::vector<double>> as_numbers(const Node& node, std::size_t count,
                                              std::string_view what, Diagnostics& diagnostics) {
  if (!node.is_sequence()) {
    report_mismatch(codes::kNotASequence, node, what, "a list of numbers", diagnostics);
    return std::nullopt;
  }
  if (node.items.size() != count) {
    diagnostics.report(
        codes::kWrongCount, node.span,
        fmt::format("{}: expected {} numbers, not {}", what, count, node.items.size()));
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (const Node& item : node.items)
    if (const auto number = as_number(item, what, diagnostics)) numbers.push_back(*number);
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

bool check_keys(const Node& node, const std::vector<std::string>& known, std::string_view what,
                Diagnostics& diagnostics) {
  if (!node.is_map()) {
    report_mismatch(codes::kNotAMap, node, what, "a map", diagnostics);
    return false;
  }
  bool all_known = true;
  for (const Node::Entry& entry : node.entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    all_known = false;
    diagnostics.report(codes::kUnknownKey, entry.key_span,
                       fmt::format("{}: unknown key \"{}\"", what, printable(entry.key, 60)),
                       suggest(entry.key, known));
  }
  return all_known;
}

}  // namespace rigc::yaml
