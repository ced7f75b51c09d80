// SPDX-License-Identifier: MIT
// Parameters in values, and conditions.
#include "templates/arguments.h"

#include <doctest/doctest.h>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

TEST_CASE("templates arguments: a whole text `$name` is a parameter, nothing else is") {
  CHECK(parameter_name(Literal::of("$size")) == "size");
  for (const char* text : {"$", "size", "$1", "a $size", "$a b", "$$a"})
    CHECK(parameter_name(Literal::of(text)).empty());
  CHECK(parameter_name(Literal::of(3.0)).empty());
}

TEST_CASE("templates arguments: substitution goes into lists and maps and keeps the place") {
  Literal list;
  list.kind = Literal::Kind::list;
  list.items = {Literal::of("$a"), Literal::of(1.0), Literal::of("$missing")};
  list.items[0].span = {1, 2, 3, 4};
  CHECK(substitute(list, {{"a", Literal::of("x")}}));
  CHECK(list.items[0].text == "x");
  CHECK(list.items[0].span == Span{1, 2, 3, 4});
  CHECK(list.items[2].text == "$missing");
  CHECK_FALSE(substitute(list, {{"a", Literal::of("x")}}));
}

TEST_CASE("templates arguments: conditions") {
  using Operator = Condition::Operator;
  const Environment environment = {{"n", Literal::of(3.0)},
                                   {"on", Literal::of(true)},
                                   {"off", Literal::of(false)},
                                   {"word", Literal::of("a")}};
  const auto test = [&](const char* name, Operator op, Literal value = {}) {
    return holds({name, op, std::move(value), {}}, environment);
  };
  CHECK(test("on", Operator::is_true));
  CHECK_FALSE(test("off", Operator::is_true));
  CHECK(test("off", Operator::is_false));
  CHECK(test("n", Operator::is_true));
  CHECK(test("n", Operator::equal, Literal::of(3.0)));
  CHECK_FALSE(test("n", Operator::not_equal, Literal::of(3.0)));
  CHECK(test("n", Operator::greater_equal, Literal::of(3.0)));
  CHECK_FALSE(test("n", Operator::greater, Literal::of(3.0)));
  CHECK(test("n", Operator::less, Literal::of(4.0)));
  CHECK(test("n", Operator::less_equal, Literal::of(3.0)));
  CHECK(test("word", Operator::equal, Literal::of("a")));
  CHECK(test("word", Operator::not_equal, Literal::of("b")));
  CHECK_FALSE(test("missing", Operator::is_false));
}

TEST_CASE("templates arguments: centimetres become metres in lengths and vectors of metres only") {
  catalog::Parameter parameter;
  parameter.type = catalog::ParameterType::length;
  Literal value = Literal::of(50.0);
  to_metres(parameter, 0.01, value);
  CHECK(value.number == 0.5);
  CHECK(value.text == "0.5");
  parameter.type = catalog::ParameterType::number;
  to_metres(parameter, 0.01, value);
  CHECK(value.number == 0.5);
}
