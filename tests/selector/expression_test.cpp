// SPDX-License-Identifier: MIT
// Tests of src/selector/expression.cpp: formulas cut at their braces.
#include <doctest/doctest.h>

#include "selector/codes.h"
#include "selector/random_selector_helpers.h"
#include "selector/selector.h"

using namespace rigc;
using namespace rigc::selector;

namespace {

const Diagnostic only_error(const std::string& text, Diagnostics& diagnostics) {
  const Span span{diagnostics.sources().add("t", "value: '" + text + "'"), 1, 8, 1};
  CAPTURE(text);
  CHECK(!parse_expression(text, span, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  return diagnostics.all()[0];
}

void check(const std::string& text, const Code& code, std::uint32_t column) {
  Diagnostics diagnostics;
  const Diagnostic error = only_error(text, diagnostics);
  CHECK(error.code->number == code.number);
  CHECK(error.place.span.column == column);
}

}  // namespace

TEST_CASE("selector expression: pieces and selectors") {
  Diagnostics diagnostics;
  const auto expression =
      parse_expression("2 * {arm_l/control@size} + {.@rotate.x | ..@roll}", Span{}, diagnostics);
  REQUIRE(expression);
  CHECK(expression->pieces == std::vector<std::string>{"2 * ", " + ", ""});
  REQUIRE(expression->selectors.size() == 2);
  CHECK(expression->selectors[0].choices[0].attribute == "size");
  CHECK(print(*expression) == "2 * {arm_l/control@size} + {.@rotate.x | ..@roll}");
}

TEST_CASE("selector expression: without braces it is one piece") {
  Diagnostics diagnostics;
  const auto expression = parse_expression("1 + 2", Span{}, diagnostics);
  REQUIRE(expression);
  CHECK(expression->pieces == std::vector<std::string>{"1 + 2"});
  CHECK(expression->selectors.empty());
}

TEST_CASE("selector expression: what is wrong and where") {
  check("", codes::kEmptyExpression, 8);
  check("  ", codes::kEmptyExpression, 8);
  check("{.@a", codes::kUnbalancedBrace, 9);
  check("1 + .@a}", codes::kUnbalancedBrace, 16);
  check("{ {.@a} }", codes::kUnbalancedBrace, 9);
  check("1 + {./control}", codes::kNotAPlug, 14);
  check("1 + {}", codes::kEmpty, 14);
  check("1 + {.@}", codes::kSyntax, 16);
}

TEST_CASE("selector expression: every wrong attribute is reported") {
  Diagnostics diagnostics;
  CHECK(!parse_expression("{.} + {a[} + {..} }", Span{}, diagnostics));
  CHECK(diagnostics.errors() == 4);
}

TEST_CASE("selector expression: parse gives the printed expression back") {
  RandomSelector random(3);
  for (int round = 0; round < 1000; ++round) {
    Expression expression;
    expression.pieces.push_back("1 + ");
    for (std::uint64_t i = random.below(4); i > 0; --i) {
      expression.selectors.push_back(random.selector(true));
      expression.pieces.push_back(random.coin() ? "" : " * 2 - ");
    }
    Diagnostics diagnostics;
    const std::string text = print(expression);
    CAPTURE(text);
    const auto again = parse_expression(text, Span{}, diagnostics);
    REQUIRE(again);
    CHECK(again->pieces == expression.pieces);
    CHECK(again->selectors == expression.selectors);
  }
}
