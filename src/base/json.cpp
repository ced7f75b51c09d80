// SPDX-License-Identifier: MIT
// Lookups in a parsed JSON document.
// Test: tests/base/json_test.cpp
#include "base/json.h"

#include <cmath>

#include "base/json_strings.h"
#include "base/text.h"

namespace rigc::json {
namespace {

/// Most keys differ in length or in the first letter: a call would cost more than looking.
bool same(std::string_view a, std::string_view b) {
  return a.size() == b.size() && (a.empty() || (a.front() == b.front() && a == b));
}

std::string escape_pointer(const std::string& key) {
  std::string text;
  for (char c : key) {
    if (c == '~')
      text += "~0";
    else if (c == '/')
      text += "~1";
    else
      text += c;
  }
  return text;
}

}  // namespace

Value Document::root() const { return items_.empty() ? Value() : Value(this, 0); }

ValueKind Value::kind() const {
  return document_ ? document_->items_[index_].kind : ValueKind::null;
}

std::size_t Value::begin() const { return document_ ? document_->items_[index_].begin : 0; }
std::size_t Value::end() const { return document_ ? document_->items_[index_].end : 0; }

std::string_view Value::text() const {
  if (!document_) return {};
  return std::string_view(document_->text_).substr(begin(), end() - begin());
}

std::size_t Value::size() const { return document_ ? document_->items_[index_].count : 0; }

Value Value::operator[](std::string_view key) const {
  if (!is_object()) return {};
  const auto& items = document_->items_;
  const char* const text = document_->text_.data();
  const std::uint32_t end = items[index_].next;
  for (std::uint32_t i = index_ + 1; i < end; i = items[i].next) {
    const auto& item = items[i];
    const std::string_view written(text + item.key_begin + 1, item.key_end - item.key_begin - 2);
    if (item.key_has_escapes ? unescape(written) == key : same(written, key)) return {document_, i};
  }
  return {};
}

std::vector<Value> Value::items() const {
  std::vector<Value> values;
  if (!is_array()) return values;
  const auto& items = document_->items_;
  values.reserve(items[index_].count);
  for (std::uint32_t i = index_ + 1; i < items[index_].next; i = items[i].next)
    values.push_back({document_, i});
  return values;
}

std::vector<std::pair<std::string, Value>> Value::members() const {
  std::vector<std::pair<std::string, Value>> values;
  if (!is_object()) return values;
  const auto& items = document_->items_;
  const std::string_view text = document_->text_;
  values.reserve(items[index_].count);
  for (std::uint32_t i = index_ + 1; i < items[index_].next; i = items[i].next) {
    const std::uint32_t first = items[i].key_begin + 1;
    values.emplace_back(unescape(text.substr(first, items[i].key_end - 1 - first)),
                        Value(document_, i));
  }
  return values;
}

std::optional<double> Value::number() const {
  if (!is_number()) return std::nullopt;
  return parse_number(text());
}

std::optional<std::int64_t> Value::integer() const {
  if (!is_number()) return std::nullopt;
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  // Most numbers of a model are indices: few digits and nothing else.
  const std::string_view digits = text();
  std::int64_t few = 0;
  std::size_t at = 0;
  while (at < digits.size() && at < 15 && digits[at] >= '0' && digits[at] <= '9')
    few = few * 10 + (digits[at++] - '0');
  if (at == digits.size()) return few;
  if (const auto whole = parse_integer(digits)) {
    if (*whole < -kMost || *whole > kMost) return std::nullopt;
    return *whole;
  }
  const auto value = parse_number(digits);
  if (!value || std::abs(*value) > static_cast<double>(kMost) || *value != std::trunc(*value))
    return std::nullopt;
  return static_cast<std::int64_t>(*value);
}

std::optional<bool> Value::boolean() const {
  if (!document_ || kind() != ValueKind::boolean) return std::nullopt;
  return text() == "true";
}

std::optional<std::string> Value::string() const {
  if (!is_string()) return std::nullopt;
  const std::string_view quoted = text();
  return unescape(quoted.substr(1, quoted.size() - 2));
}

std::string Value::pointer() const {
  if (!document_) return {};
  const auto& items = document_->items_;
  const std::string_view text = document_->text_;
  std::string path;
  for (std::uint32_t i = index_; i != 0; i = items[i].parent) {
    const std::uint32_t parent = items[i].parent;
    std::string step;
    if (items[parent].kind == ValueKind::object) {
      const std::uint32_t first = items[i].key_begin + 1;
      step = escape_pointer(unescape(text.substr(first, items[i].key_end - 1 - first)));
    } else {
      std::size_t ordinal = 0;
      for (std::uint32_t j = parent + 1; j != i; j = items[j].next) ++ordinal;
      step = std::to_string(ordinal);
    }
    path = '/' + step + path;
  }
  return path;
}

}  // namespace rigc::json
