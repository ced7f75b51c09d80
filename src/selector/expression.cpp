// SPDX-License-Identifier: MIT
// Cuts an expression at its braces and parses the selectors between them.
// Test: tests/selector/expression_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "selector/codes.h"
#include "selector/locate.h"
#include "selector/selector.h"

namespace rigc::selector {
namespace {

bool parse_plug(std::string_view text, const Span& span, Expression& expression,
                Diagnostics& diagnostics) {
  auto selector = parse(text, span, diagnostics);
  if (!selector) return false;
  const bool is_plug = !selector->choices[0].attribute.empty();
  if (!is_plug) {
    diagnostics.report(codes::kNotAPlug, span,
                       fmt::format("`{}` names a node, not an attribute", printable(text)),
                       fmt::format("write `{{{}@attribute}}`", printable(text)));
  }
  expression.selectors.push_back(std::move(*selector));
  return is_plug;
}

}  // namespace

std::optional<Expression> parse_expression(std::string_view text, const Span& span,
                                           Diagnostics& diagnostics) {
  if (trim(text).empty()) {
    diagnostics.report(codes::kEmptyExpression, span, "the expression is empty");
    return std::nullopt;
  }
  Locator locator(text, span, diagnostics.sources());
  const auto unbalanced = [&](std::size_t at, const char* message, const char* hint) {
    diagnostics.report(codes::kUnbalancedBrace, locator.at(at, 1), message, hint);
  };
  Expression expression;
  bool ok = true;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t open = text.find_first_of("{}", begin);
    expression.pieces.emplace_back(text.substr(begin, open - begin));
    if (open == std::string_view::npos) break;
    if (text[open] == '}') {
      unbalanced(open, "`}` without a `{` before it", "");
      ok = false;
      begin = open + 1;
      expression.pieces.pop_back();
      continue;
    }
    const std::size_t close = text.find_first_of("{}", open + 1);
    if (close == std::string_view::npos || text[close] == '{') {
      unbalanced(open, "`{` without a `}` after it",
                 "every attribute stands between its own `{` and `}`");
      return std::nullopt;
    }
    const Span inside = locator.at(open + 1, close - open - 1);
    ok &= parse_plug(text.substr(open + 1, close - open - 1), inside, expression, diagnostics);
    begin = close + 1;
  }
  if (!ok) return std::nullopt;
  return expression;
}

}  // namespace rigc::selector
