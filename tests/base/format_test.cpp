// SPDX-License-Identifier: MIT
// Tables of keys: what a reader checks with them.
#include "base/format.h"

#include <doctest/doctest.h>

#include "base/codes.h"

using namespace rigc;

namespace {

const yaml::Section kLamp{
    "lamp",
    "a lamp",
    {{"size", yaml::Form::number, "How large.", {.required = true}},
     {"colour", yaml::Form::word, "Of its light.", {.words = {"red", "blue"}}}}};

Diagnostics checked(const std::string& text, bool good) {
  Diagnostics diagnostics;
  const auto node = yaml::read(diagnostics.sources().add("x.yaml", text), diagnostics);
  CHECK(yaml::check_section(*node, kLamp, diagnostics) == good);
  return diagnostics;
}

}  // namespace

TEST_CASE("base format: keys of a section") {
  CHECK(checked("{size: 1, colour: red}", true).ok());
  CHECK(checked("{}", true).ok());  // what is required is the reader's
  const Diagnostics unknown = checked("{size: 1, color: red}", false);
  REQUIRE(unknown.all().size() == 1);
  CHECK(unknown.all()[0].code->number == codes::kUnknownKey.number);
  CHECK(unknown.all()[0].message == "a lamp: unknown key \"color\"");
  CHECK(unknown.all()[0].hint == "did you mean \"colour\"?");
  CHECK(checked("[1]", false).all()[0].code->number == codes::kNotAMap.number);
}

TEST_CASE("base format: what a section knows of a key") {
  REQUIRE(kLamp.find("size"));
  CHECK(kLamp.find("size")->rule.required);
  CHECK_FALSE(kLamp.find("length"));
  CHECK(kLamp.words("colour") == std::vector<std::string>{"red", "blue"});
}
