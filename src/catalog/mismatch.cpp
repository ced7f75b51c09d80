// SPDX-License-Identifier: MIT
// Says why a value cannot be an argument of a parameter; nothing if it can.
// Test: tests/catalog/mismatch_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "catalog/descriptor.h"

namespace rigc::catalog {
namespace {

using Kind = Literal::Kind;
using Result = std::optional<Mismatch>;

const std::vector<std::string> kInterpolations = {"none", "linear", "smooth", "spline"};

std::string found(const Literal& value) {
  switch (value.kind) {
    case Kind::null:
      return "nothing";
    case Kind::number:
      return value.text.empty() ? number_text(value.number) : printable(value.text, 60);
    case Kind::boolean:
      return value.flag ? "true" : "false";
    case Kind::text:
      return fmt::format("\"{}\"", printable(value.text, 60));
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map";
  }
  return {};
}

bool are_numbers(const Literal& value, std::size_t count) {
  return value.kind == Kind::list && value.items.size() == count &&
         std::all_of(value.items.begin(), value.items.end(),
                     [](const Literal& item) { return item.kind == Kind::number; });
}

class Checker {
 public:
  explicit Checker(const Parameter& parameter) : parameter_(parameter) {}

  Result check(const Literal& value) const;

 private:
  Result wrong(const Literal& value, std::string message, std::string hint = {}) const {
    return Mismatch{value.span, fmt::format("{}: {}", parameter_.name, message), std::move(hint)};
  }
  Result expected(const Literal& value, std::string_view what, std::string hint = {}) const {
    return wrong(value, fmt::format("expected {}, not {}", what, found(value)), std::move(hint));
  }
  Result text(const Literal& value, std::string_view what) const;
  Result texts(const Literal& value, std::string_view one, std::string_view all) const;
  Result number(const Literal& value) const;
  Result numbers(const Literal& value) const;
  Result color(const Literal& value) const;
  Result word(const Literal& value) const;
  Result curve(const Literal& value) const;
  Result table(const Literal& value) const;
  Result any(const Literal& value) const;

  const Parameter& parameter_;
};

Result Checker::check(const Literal& value) const {
  switch (parameter_.type) {
    case ParameterType::node:
    case ParameterType::plug:
      return text(value, "a selector");
    case ParameterType::nodes:
    case ParameterType::plugs:
      return texts(value, "a selector", "a selector or a list of selectors");
    case ParameterType::texts:
      return texts(value, "a text", "a list of texts");
    case ParameterType::expression:
      return value.kind == Kind::number ? Result() : text(value, "an expression");
    case ParameterType::text:
      return text(value, "text");
    case ParameterType::number:
    case ParameterType::integer:
    case ParameterType::angle:
    case ParameterType::length:
      return number(value);
    case ParameterType::numbers:
      return numbers(value);
    case ParameterType::boolean:
      return value.kind == Kind::boolean ? Result() : expected(value, "true or false");
    case ParameterType::vec3:
      return are_numbers(value, 3) ? Result() : expected(value, "three numbers, [x, y, z]");
    case ParameterType::color:
      return color(value);
    case ParameterType::enumeration:
      return word(value);
    case ParameterType::curve:
      return curve(value);
    case ParameterType::table:
      return table(value);
    case ParameterType::value:
      return any(value);
  }
  return std::nullopt;
}

Result Checker::text(const Literal& value, std::string_view what) const {
  if (value.kind == Kind::text && !value.text.empty()) return std::nullopt;
  const bool plain = value.kind == Kind::number || value.kind == Kind::boolean;
  return expected(value, what, plain ? "put it in quotes to make it a text" : "");
}

Result Checker::texts(const Literal& value, std::string_view one, std::string_view all) const {
  if (value.kind != Kind::list) return text(value, all);
  if (value.items.empty()) return wrong(value, "the list is empty");
  for (const Literal& item : value.items) {
    if (auto result = text(item, one)) return result;
  }
  return std::nullopt;
}

Result Checker::number(const Literal& value) const {
  const bool whole = parameter_.type == ParameterType::integer;
  if (value.kind != Kind::number) return expected(value, whole ? "a whole number" : "a number");
  if (whole && (value.number != std::trunc(value.number) || std::abs(value.number) > 1e9)) {
    return expected(value, "a whole number");
  }
  if (parameter_.min && value.number < *parameter_.min) {
    return wrong(value, fmt::format("{} is below the smallest value, {}", found(value),
                                    number_text(*parameter_.min)));
  }
  if (parameter_.max && value.number > *parameter_.max) {
    return wrong(value, fmt::format("{} is above the largest value, {}", found(value),
                                    number_text(*parameter_.max)));
  }
  return std::nullopt;
}

Result Checker::numbers(const Literal& value) const {
  if (value.kind != Kind::list) return expected(value, "a list of numbers");
  for (const Literal& item : value.items) {
    if (auto result = number(item)) return result;
  }
  return std::nullopt;
}

Result Checker::color(const Literal& value) const {
  if (value.kind == Kind::text) {
    if (named_color(value.text)) return std::nullopt;
    return wrong(value, fmt::format("there is no colour {}", found(value)),
                 suggest(value.text, color_names()));
  }
  if (!are_numbers(value, 3)) return expected(value, "a colour's name or [r, g, b]");
  for (const Literal& item : value.items) {
    if (item.number >= 0 && item.number <= 1) continue;
    return wrong(item, fmt::format("{} lies outside 0..1", found(item)),
                 "red, green and blue go from 0 to 1");
  }
  return std::nullopt;
}

Result Checker::word(const Literal& value) const {
  const auto& values = parameter_.values;
  if (value.kind != Kind::text) return expected(value, "one of " + join(values, ", "));
  if (std::find(values.begin(), values.end(), value.text) != values.end()) return std::nullopt;
  return wrong(value, fmt::format("{} is not one of its values", found(value)),
               suggest(value.text, values));
}

Result Checker::curve(const Literal& value) const {
  constexpr std::string_view kPoint = "a point [x, y] or [x, y, interpolation]";
  if (value.kind != Kind::list || value.items.size() < 2) {
    return expected(value, "a list of at least two points");
  }
  const Literal* before = nullptr;
  for (const Literal& point : value.items) {
    const bool with_word = point.kind == Kind::list && point.items.size() == 3;
    Literal position = point;
    if (with_word) position.items.pop_back();
    if (!are_numbers(position, 2)) return expected(point, kPoint);
    if (with_word) {
      const Literal& word = point.items[2];
      if (word.kind != Kind::text) return expected(word, "an interpolation");
      if (std::count(kInterpolations.begin(), kInterpolations.end(), word.text) == 0) {
        return wrong(word, fmt::format("there is no interpolation {}", found(word)),
                     suggest(word.text, kInterpolations));
      }
    }
    if (before && point.items[0].number <= before->number) {
      return wrong(point.items[0],
                   fmt::format("position {} is not above the one before, {}", found(point.items[0]),
                               found(*before)),
                   "the points of a curve go from left to right");
    }
    before = &point.items[0];
  }
  return std::nullopt;
}

Result Checker::table(const Literal& value) const {
  if (value.kind != Kind::list || value.items.empty()) return expected(value, "a list of rows");
  for (const Literal& row : value.items) {
    const std::size_t wide = row.items.size();
    if (wide == 0 || !are_numbers(row, wide)) return expected(row, "a row of numbers");
    const std::size_t first = value.items.front().items.size();
    if (wide != first) {
      return wrong(row, fmt::format("a row of {} where the first has {}", wide, first),
                   "all rows of a table have as many numbers");
    }
  }
  return std::nullopt;
}

Result Checker::any(const Literal& value) const {
  if (value.kind == Kind::number || value.kind == Kind::boolean || value.kind == Kind::text ||
      are_numbers(value, 3)) {
    return std::nullopt;
  }
  return expected(value, "a number, true or false, a text or [x, y, z]");
}

}  // namespace

std::optional<Mismatch> mismatch(const Parameter& parameter, const Literal& value) {
  return Checker(parameter).check(value);
}

}  // namespace rigc::catalog
