// SPDX-License-Identifier: MIT
// Small readers that all pieces of a template share: vectors, lists of names, conditions.
// Test: tests/templates/read_test.cpp
#include "templates/reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "templates/arguments.h"
#include "templates/codes.h"

namespace rigc::templates {

const yaml::Node* Reader::required(const yaml::Node& map, std::string_view key,
                                   std::string_view what) {
  if (!map.is_map()) return nullptr;
  const yaml::Node* node = map.find(key);
  if (!node) error(codes::kMissingKey, map.span, fmt::format("{} needs `{}:`", what, key));
  return node;
}

bool Reader::at_most(const yaml::Node& node, std::size_t limit, std::string_view what) {
  const std::size_t count = node.is_map() ? node.entries.size() : node.items.size();
  if (count <= limit) return true;
  error(codes::kNotAllowed, node.span,
        fmt::format("{}: {} are too many, at most {} are allowed", what, count, limit));
  return false;
}

std::vector<std::string> Reader::names(const yaml::Node& node, std::string_view what) {
  std::vector<std::string> found;
  const auto add = [&](const yaml::Node& item) {
    const auto name = yaml::as_name(item, what, diagnostics);
    if (!name) return;
    if (std::find(found.begin(), found.end(), *name) != found.end())
      error(codes::kDuplicateWord, item.span,
            fmt::format("{}: \"{}\" is there already", what, *name), "remove it");
    else
      found.push_back(*name);
  };
  if (!node.is_sequence()) {
    add(node);
    return found;
  }
  if (!at_most(node, 64, what)) return found;
  for (const yaml::Node& item : node.items) add(item);
  return found;
}

std::optional<math::Vec3> Reader::vector(const yaml::Node& node, std::string_view what) {
  const auto numbers = yaml::as_numbers(node, 3, what, diagnostics);
  if (!numbers) return std::nullopt;
  return math::Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

std::optional<math::Vec3> Reader::metres(const yaml::Node& node, std::string_view what) {
  const auto found = vector(node, what);
  if (!found || out.metres_per_unit == 1) return found;
  return *found * out.metres_per_unit;
}

std::optional<math::Quat> Reader::euler(const yaml::Node& node, std::string_view what) {
  const auto degrees = vector(node, what);
  if (!degrees) return std::nullopt;
  return math::from_euler_degrees(*degrees);
}

bool Reader::check_declared(std::string_view parameter, const Span& span) {
  if (out.find_parameter(parameter)) return true;
  std::vector<std::string> declared;
  for (const catalog::Parameter& candidate : out.parameters) declared.push_back(candidate.name);
  error(codes::kUnknownParameter, span,
        fmt::format("the template has no parameter \"{}\"", printable(parameter, 60)),
        suggest(parameter, declared));
  return false;
}

namespace {

std::optional<Condition::Operator> operator_from(std::string_view text) {
  using Operator = Condition::Operator;
  if (text == "==") return Operator::equal;
  if (text == "!=") return Operator::not_equal;
  if (text == "<") return Operator::less;
  if (text == "<=") return Operator::less_equal;
  if (text == ">") return Operator::greater;
  if (text == ">=") return Operator::greater_equal;
  return std::nullopt;
}

bool is_order(Condition::Operator op) {
  return op != Condition::Operator::is_true && op != Condition::Operator::is_false &&
         op != Condition::Operator::equal && op != Condition::Operator::not_equal;
}

Literal plain_value(std::string_view text) {
  if (const auto number = parse_number(text)) return Literal::of(*number);
  if (text == "true" || text == "on") return Literal::of(true);
  if (text == "false" || text == "off") return Literal::of(false);
  return Literal::of(std::string(text));
}

/// Words between blanks.
std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> found;
  for (const std::string_view word : split(text, ' '))
    if (!trim(word).empty()) found.push_back(trim(word));
  return found;
}

/// Nothing where the words are none of the three forms.
std::optional<Condition> parse_condition(const std::vector<std::string_view>& parts) {
  Condition condition;
  const bool negated = parts.size() == 2 && parts[0] == "not";
  if (parts.size() != 1 && parts.size() != 3 && !negated) return std::nullopt;
  const std::string_view name = negated ? parts[1] : parts[0];
  if (name.size() < 2 || name[0] != '$' || !is_name(name.substr(1))) return std::nullopt;
  condition.parameter = name.substr(1);
  if (negated) condition.op = Condition::Operator::is_false;
  if (parts.size() == 3) {
    const auto op = operator_from(parts[1]);
    if (!op) return std::nullopt;
    condition.op = *op;
    condition.value = plain_value(parts[2]);
    if (is_order(*op) && condition.value.kind != Literal::Kind::number) return std::nullopt;
  }
  return condition;
}

}  // namespace

std::optional<Condition> Reader::condition(const yaml::Node& node) {
  const auto text = yaml::as_text(node, "if", diagnostics);
  if (!text) return std::nullopt;
  auto condition = parse_condition(words(*text));
  if (!condition) {
    error(codes::kBadCondition, node.span,
          fmt::format("\"{}\" is not a condition", printable(*text, 60)),
          "write `$name`, `not $name` or `$name >= 3`");
    return std::nullopt;
  }
  condition->span = node.span;
  if (!check_declared(condition->parameter, node.span)) return std::nullopt;
  const auto type = out.find_parameter(condition->parameter)->type;
  const bool has_order =
      type == catalog::ParameterType::number || type == catalog::ParameterType::integer ||
      type == catalog::ParameterType::angle || type == catalog::ParameterType::length;
  if (is_order(condition->op) && !has_order) {
    error(codes::kBadCondition, node.span,
          fmt::format("\"{}\" is no number and has no order", condition->parameter),
          "use == or !=");
    return std::nullopt;
  }
  return condition;
}

}  // namespace rigc::templates
