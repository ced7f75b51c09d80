// SPDX-License-Identifier: MIT
// Where a piece of a selector's text stands in its source: in go the text and the span of the whole
// value, out come spans of pieces. Test: tests/selector/parse_test.cpp
#pragma once

#include <optional>
#include <string_view>

#include "base/span.h"

namespace rigc::selector {

/// Maps offsets in a text to spans. Quotes are stepped over; where the source spells the text
/// otherwise (escapes, block scalars), every offset maps to the whole value.
class Locator {
 public:
  Locator(std::string_view text, const Span& span, const Sources& sources)
      : text_(text), span_(span), sources_(sources) {}
  Span at(std::size_t offset, std::size_t length);
  /// The span of the whole value, without a look into its source: every selector keeps one.
  const Span& whole() const { return span_; }

 private:
  std::optional<std::uint32_t> first_column() const;

  std::string_view text_;
  Span span_;
  const Sources& sources_;
  bool looked_ = false;  // finding a line costs time: only pieces that are asked for are looked up
  std::optional<std::uint32_t> first_;
};

}  // namespace rigc::selector
