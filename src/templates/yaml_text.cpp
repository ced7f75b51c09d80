// SPDX-License-Identifier: MIT
// Values as YAML text. Test: tests/templates/write_test.cpp
#include "templates/yaml_text.h"

#include <algorithm>
#include <cctype>

#include "base/json.h"
#include "base/text.h"

namespace rigc::templates {
namespace {

/// What YAML or rigc would take for something other than a text.
bool is_word_of_yaml(std::string_view text) {
  static constexpr std::string_view kWords[] = {"true", "false", "on", "off", "yes", "no",
                                                "null", "y",     "n",  "inf", "nan", "infinity"};
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(std::begin(kWords), std::end(kWords), lower) != std::end(kWords);
}

bool is_plain(std::string_view text) {
  if (text.empty() || is_word_of_yaml(text) || parse_number(text)) return false;
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_one_of = [](char c, std::string_view set) {
    return set.find(c) != std::string_view::npos;
  };
  if (!is_letter(text.front()) && !is_one_of(text.front(), "_.+/")) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool digit = c >= '0' && c <= '9';
    if (!is_letter(c) && !digit && !is_one_of(c, "_./#|@+-;()=<> ")) return false;
    if (c == '#' && text[i - 1] == ' ') return false;
  }
  return text.back() != ' ';
}

}  // namespace

std::string yaml_text(std::string_view text) {
  return is_plain(text) ? std::string(text) : json::quote(text);
}

std::string yaml_texts(const std::vector<std::string>& texts) {
  if (texts.size() == 1) return yaml_text(texts.front());
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(yaml_text(text));
  return "[" + join(items, ", ") + "]";
}

std::string yaml_numbers(const double* numbers, std::size_t count) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < count; ++i) items.push_back(number_text(numbers[i]));
  return "[" + join(items, ", ") + "]";
}

std::string yaml_vector(const math::Vec3& vector) { return yaml_numbers(&vector.x, 3); }

std::string yaml_text(const Literal& literal) {
  std::vector<std::string> items;
  switch (literal.kind) {
    case Literal::Kind::null:
      return "~";
    case Literal::Kind::number:
      return number_text(literal.number);
    case Literal::Kind::boolean:
      return literal.flag ? "true" : "false";
    case Literal::Kind::text:
      return yaml_text(literal.text);
    case Literal::Kind::list:
      for (const Literal& item : literal.items) items.push_back(yaml_text(item));
      return "[" + join(items, ", ") + "]";
    case Literal::Kind::map:
      for (const auto& [key, value] : literal.entries)
        items.push_back(yaml_text(key) + ": " + yaml_text(value));
      return "{" + join(items, ", ") + "}";
  }
  return {};
}

}  // namespace rigc::templates
