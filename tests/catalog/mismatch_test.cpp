// SPDX-License-Identifier: MIT
// Tests of src/catalog/mismatch.cpp: which values fit which types, and what is said of the others.
#include <doctest/doctest.h>

#include "base/yaml.h"
#include "catalog/descriptor.h"

using namespace rigc;
using namespace rigc::catalog;

namespace {

Literal literal(const std::string& yaml_text) {
  Diagnostics diagnostics;
  const auto node = yaml::read(diagnostics.sources().add("t", "v: " + yaml_text), diagnostics);
  REQUIRE(node);
  return *literal_from(*node->find("v"), diagnostics);
}

Parameter parameter(ParameterType type) {
  Parameter result;
  result.name = "p";
  result.type = type;
  return result;
}

std::string message(const Parameter& what, const std::string& value) {
  const auto wrong = mismatch(what, literal(value));
  return wrong ? wrong->message : "";
}

struct Case {
  ParameterType type;
  std::vector<const char*> good;
  std::vector<std::pair<const char*, const char*>> bad;
};

}  // namespace

TEST_CASE("catalog mismatch: types") {
  using T = ParameterType;
  const Case cases[] = {
      {T::node,
       {"./control", ".", "'3'"},
       {{"3", "p: expected a selector, not 3"}, {"[a]", "p: expected a selector, not a list"}}},
      {T::plug, {".@roll"}, {{"~", "p: expected a selector, not nothing"}}},
      {T::nodes,
       {"a[*]", "[a, b]"},
       {{"[]", "p: the list is empty"},
        {"[a, 1]", "p: expected a selector, not 1"},
        {"{a: 1}", "p: expected a selector or a list of selectors, not a map"}}},
      {T::plugs,
       {"a@b", "[a@b]"},
       {{"on", "p: expected a selector or a list of selectors, not true"}}},
      {T::number,
       {"1", "-2.5e3"},
       {{"x", "p: expected a number, not \"x\""}, {"on", "p: expected a number, not true"}}},
      {T::numbers,
       {"[1, 2.5]", "[]"},
       {{"1", "p: expected a list of numbers, not 1"},
        {"[1, a]", "p: expected a number, not \"a\""}}},
      {T::integer,
       {"1", "-7", "2.0"},
       {{"1.5", "p: expected a whole number, not 1.5"},
        {"1e12", "p: expected a whole number, not 1e12"}}},
      {T::boolean, {"on", "false"}, {{"1", "p: expected true or false, not 1"}}},
      {T::angle, {"90"}, {{"a", "p: expected a number, not \"a\""}}},
      {T::length, {"0.1"}, {{"[1]", "p: expected a number, not a list"}}},
      {T::vec3,
       {"[0, 1, 2]"},
       {{"[0, 1]", "p: expected three numbers, [x, y, z], not a list"},
        {"[0, 1, a]", "p: expected three numbers, [x, y, z], not a list"}}},
      {T::color,
       {"red", "[0, 0.5, 1]"},
       {{"rde", "p: there is no colour \"rde\""},
        {"[0, 0.5, 2]", "p: 2 lies outside 0..1"},
        {"3", "p: expected a colour's name or [r, g, b], not 3"}}},
      {T::text,
       {"a b", "'1'"},
       {{"1", "p: expected text, not 1"}, {"''", "p: expected text, not \"\""}}},
      {T::curve,
       {"[[0, 0], [1, 1]]", "[[0, 0, smooth], [0.5, 2, none], [1, 1]]"},
       {{"[[0, 0]]", "p: expected a list of at least two points, not a list"},
        {"[[0, 0], 1]", "p: expected a point [x, y] or [x, y, interpolation], not 1"},
        {"[[0, 0], [1]]", "p: expected a point [x, y] or [x, y, interpolation], not a list"},
        {"[[0, 0, 3], [1, 1]]", "p: expected an interpolation, not 3"},
        {"[[0, 0, smoth], [1, 1]]", "p: there is no interpolation \"smoth\""},
        {"[[0, 0], [0, 1]]", "p: position 0 is not above the one before, 0"}}},
      {T::expression, {"'{.@a} * 2'", "2"}, {{"on", "p: expected an expression, not true"}}},
      {T::value,
       {"1", "on", "text", "[1, 2, 3]"},
       {{"[1, 2]", "p: expected a number, true or false, a text or [x, y, z], not a list"}}},
      {T::texts,
       {"a", "[a, b]"},
       {{"3", "p: expected a list of texts, not 3"}, {"[a, 3]", "p: expected a text, not 3"}}},
      {T::table,
       {"[[1]]", "[[1, 2], [3, 4]]"},
       {{"3", "p: expected a list of rows, not 3"},
        {"[1, 2]", "p: expected a row of numbers, not 1"},
        {"[[1, a]]", "p: expected a row of numbers, not a list"},
        {"[[1, 2], [3]]", "p: a row of 1 where the first has 2"}}},
  };
  for (const Case& one : cases) {
    CAPTURE(name_of(one.type));
    for (const char* value : one.good) CHECK(message(parameter(one.type), value) == "");
    for (const auto& [value, expected] : one.bad) {
      CHECK(message(parameter(one.type), value) == expected);
    }
  }
  CHECK(std::size(cases) == static_cast<std::size_t>(T::table));  // all but enum
}

TEST_CASE("catalog mismatch: ranges and enums") {
  Parameter number = parameter(ParameterType::number);
  number.min = 0;
  number.max = 2;
  CHECK(message(number, "0") == "");
  CHECK(message(number, "2") == "");
  CHECK(message(number, "-0.5") == "p: -0.5 is below the smallest value, 0");
  CHECK(message(number, "2.01") == "p: 2.01 is above the largest value, 2");
  number.type = ParameterType::numbers;
  CHECK(message(number, "[1, 3]") == "p: 3 is above the largest value, 2");
  Parameter word = parameter(ParameterType::enumeration);
  word.values = {"forward", "backward"};
  CHECK(message(word, "forward") == "");
  CHECK(message(word, "3") == "p: expected one of forward, backward, not 3");
  const auto wrong = mismatch(word, literal("forwrad"));
  REQUIRE(wrong);
  CHECK(wrong->message == "p: \"forwrad\" is not one of its values");
  CHECK(wrong->hint == "did you mean \"forward\"?");
}

TEST_CASE("catalog mismatch: it points at the wrong item") {
  const Literal value = literal("[[0, 0], [1, 1, cubic]]");
  const auto wrong = mismatch(parameter(ParameterType::curve), value);
  REQUIRE(wrong);
  CHECK(wrong->span == value.items[1].items[2].span);
}
