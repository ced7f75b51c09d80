// SPDX-License-Identifier: MIT
// Tests of the typed readers in src/base/yaml.h.
#include <doctest/doctest.h>

#include "base/codes.h"
#include "base/yaml.h"

using namespace rigc;
using yaml::Node;

namespace {

/// A one-line YAML text, and what a reader reported about it.
struct Case {
  Diagnostics diagnostics;
  Node node;
  explicit Case(const std::string& text) {
    const std::uint32_t file = diagnostics.sources().add("x.yaml", text);
    node = yaml::read(file, diagnostics).value();
  }
  bool reported(const Code& code) const {
    return diagnostics.all().size() == 1 && diagnostics.all()[0].code->number == code.number;
  }
  const std::string& hint() const { return diagnostics.all().at(0).hint; }
};

}  // namespace

TEST_CASE("base yaml values: numbers") {
  Case good("-2.5e1");
  CHECK(yaml::as_number(good.node, "size", good.diagnostics) == -25);
  Case octal("017");
  CHECK(yaml::as_number(octal.node, "size", octal.diagnostics) == 17);
  for (const char* text : {"abc", "0x10", ".inf", ".nan", "1e999", "~", "[1]", "{a: 1}", "1 m"}) {
    Case bad(text);
    CHECK(!yaml::as_number(bad.node, "size", bad.diagnostics));
    CHECK_MESSAGE(bad.reported(codes::kNotANumber), text);
  }
  Case quoted("'1'");
  CHECK(!yaml::as_number(quoted.node, "size", quoted.diagnostics));
  CHECK(quoted.hint() == "remove the quotes");
  Case word("x");
  CHECK(!yaml::as_number(word.node, "size", word.diagnostics));
  CHECK(word.diagnostics.all()[0].message == "size: expected a number, not \"x\"");
}

TEST_CASE("base yaml values: integers") {
  Case good("+7");
  CHECK(yaml::as_integer(good.node, "version", good.diagnostics) == 7);
  for (const char* text : {"1.0", "1e3", "", "99999999999999999999", "'1'"}) {
    Case bad(text);
    CHECK(!yaml::as_integer(bad.node, "version", bad.diagnostics));
    CHECK_MESSAGE(bad.reported(codes::kNotAnInteger), text);
  }
}

TEST_CASE("base yaml values: booleans") {
  for (const char* text : {"true", "on", "false", "off"}) {
    Case good(text);
    const std::string word = text;
    CHECK(yaml::as_bool(good.node, "on", good.diagnostics) == (word == "true" || word == "on"));
  }
  for (const char* text : {"yes", "no", "Yes", "NO", "y"}) {
    Case bad(text);
    CHECK(!yaml::as_bool(bad.node, "on", bad.diagnostics));
    CHECK(bad.reported(codes::kNotABoolean));
    CHECK(bad.hint() == "write true or false (or on/off)");
  }
  Case upper("True");
  CHECK(!yaml::as_bool(upper.node, "on", upper.diagnostics));
  CHECK(upper.hint() == "write it in lower case");
  Case quoted("'true'");
  CHECK(!yaml::as_bool(quoted.node, "on", quoted.diagnostics));
  CHECK(quoted.hint() == "remove the quotes");
}

TEST_CASE("base yaml values: text and names") {
  Case text("some words");
  CHECK(yaml::as_text(text.node, "title", text.diagnostics) == "some words");
  Case empty("''");
  CHECK(yaml::as_text(empty.node, "title", empty.diagnostics) == "");
  Case nothing("~");
  CHECK(!yaml::as_text(nothing.node, "title", nothing.diagnostics));
  CHECK(nothing.reported(codes::kNotText));
  Case name("arm_l");
  CHECK(yaml::as_name(name.node, "local", name.diagnostics) == "arm_l");
  Case bad("arm.l");
  CHECK(!yaml::as_name(bad.node, "local", bad.diagnostics));
  CHECK(bad.reported(codes::kNotAName));
}

TEST_CASE("base yaml values: lists of numbers") {
  Case good("[1, 2.5, -3]");
  CHECK(yaml::as_numbers(good.node, 3, "at", good.diagnostics) == std::vector<double>{1, 2.5, -3});
  Case few("[1, 2]");
  CHECK(!yaml::as_numbers(few.node, 3, "at", few.diagnostics));
  CHECK(few.reported(codes::kWrongCount));
  Case scalar("1");
  CHECK(!yaml::as_numbers(scalar.node, 3, "at", scalar.diagnostics));
  CHECK(scalar.reported(codes::kNotASequence));
  Case two("[a, 1, b]");
  CHECK(!yaml::as_numbers(two.node, 3, "at", two.diagnostics));
  CHECK(two.diagnostics.errors() == 2);
}

TEST_CASE("base yaml values: unknown keys") {
  Case good("{name: a, at: b}");
  CHECK(yaml::check_keys(good.node, {"name", "at"}, "joint", good.diagnostics));
  Case bad("{nmae: a, at: b, zzzzzz: c}");
  CHECK(!yaml::check_keys(bad.node, {"name", "at"}, "joint", bad.diagnostics));
  REQUIRE(bad.diagnostics.errors() == 2);
  CHECK(bad.diagnostics.all()[0].code->number == codes::kUnknownKey.number);
  CHECK(bad.hint() == "did you mean \"name\"?");
  CHECK(bad.diagnostics.all()[0].place.span.column == 2);
  Case list("[1]");
  CHECK(!yaml::check_keys(list.node, {"name"}, "joint", list.diagnostics));
  CHECK(list.reported(codes::kNotAMap));
}
