// SPDX-License-Identifier: MIT
// Finds a value's text again in its source line, so that carets point into it.
// Test: tests/selector/parse_test.cpp
#include "selector/locate.h"

#include "base/text.h"

namespace rigc::selector {

/// Column where the text begins; nothing where the source spells it otherwise.
std::optional<std::uint32_t> Locator::first_column() const {
  if (!span_.known() || span_.column == 0) return span_.column;
  const std::string_view line = sources_.line(span_.file, span_.line);
  const std::size_t column = span_.column - 1;
  if (column >= line.size() || starts_with(line.substr(column), text_)) return span_.column;
  const bool quoted = line[column] == '"' || line[column] == '\'';
  if (quoted && starts_with(line.substr(column + 1), text_)) return span_.column + 1;
  return std::nullopt;
}

Span Locator::at(std::size_t offset, std::size_t length) {
  if (!looked_) first_ = first_column();
  looked_ = true;
  if (!first_) return span_;
  Span span = span_;
  span.column = *first_ + static_cast<std::uint32_t>(offset);
  span.length = static_cast<std::uint32_t>(length);
  return span;
}

}  // namespace rigc::selector
