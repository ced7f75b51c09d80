// SPDX-License-Identifier: MIT
// Tests of the parser and the lookups in src/base/json.h.
#include "base/json.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "base/codes.h"

using namespace rigc;

namespace {

/// The code of the error, 0 for none.
int code_of(std::string text) {
  Diagnostics diagnostics;
  const auto document = json::parse(std::move(text), "x.json", 0, diagnostics);
  CHECK(document.has_value() == diagnostics.ok());
  return diagnostics.ok() ? 0 : diagnostics.all()[0].code->number;
}

json::Document good(std::string text) {
  Diagnostics diagnostics;
  auto document = json::parse(std::move(text), "x.json", 0, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(document);
  return std::move(*document);
}

std::string repeat(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("base json: lookups") {
  const auto document =
      good(R"( {"a": [1, -2.5e1, true, null, "x"], "b": {"c/~": {}}, "d\u00e9": false} )");
  const json::Value root = document.root();
  CHECK(root.is_object());
  CHECK(root.size() == 3);
  const auto items = root["a"].items();
  REQUIRE(items.size() == 5);
  CHECK(items[0].integer() == 1);
  CHECK(items[1].number() == -25);
  CHECK(items[2].boolean() == true);
  CHECK(items[3].kind() == json::ValueKind::null);
  CHECK(items[4].string() == "x");
  CHECK(items[4].pointer() == "/a/4");
  CHECK(root["b"]["c/~"].pointer() == "/b/c~1~0");
  CHECK(root["b"]["c/~"].is_object());
  CHECK(root["d\xc3\xa9"].boolean() == false);
  CHECK(root.members()[2].first == "d\xc3\xa9");
  CHECK(root["a"].text() == R"([1, -2.5e1, true, null, "x"])");
  CHECK(root["a"].begin() == 7);
  CHECK(root.pointer() == "");
}

TEST_CASE("base json: missing values") {
  const auto document = good("[1]");
  const json::Value none = document.root()["a"]["b"];
  CHECK(!none);
  CHECK(none.items().empty());
  CHECK(none.members().empty());
  CHECK(none.size() == 0);
  CHECK(none.text() == "");
  CHECK(none.pointer() == "");
  CHECK(!none.number());
  CHECK(!none.integer());
  CHECK(!none.boolean());
  CHECK(!none.string());
  CHECK(!document.root().items()[0].string());
  CHECK(!json::Document().root());
}

TEST_CASE("base json: integers") {
  const auto document = good(
      "[1e3, 5.0, 0.5, 9007199254740992, 9007199254740993, -9007199254740992, 1e300, -0, 1e-400]");
  const auto items = document.root().items();
  CHECK(items[0].integer() == 1000);
  CHECK(items[1].integer() == 5);
  CHECK(!items[2].integer());
  CHECK(items[3].integer() == 9007199254740992);
  CHECK(!items[4].integer());
  CHECK(items[5].integer() == -9007199254740992);
  CHECK(!items[6].integer());
  CHECK(items[7].integer() == 0);
  CHECK(items[8].number() == 0);
}

TEST_CASE("base json: strings") {
  const auto document = good(R"(["\"\\\/\b\f\n\r\t\u0041\u00e9\u20ac\ud83d\ude00\u0000"])");
  const std::string expected("\"\\/\b\f\n\r\tA\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\0", 19);
  CHECK(document.root().items()[0].string() == expected);
}

TEST_CASE("base json: what is refused, and with which code") {
  for (const char* text : {"",         " ",
                           "{",        "[",
                           "[1,]",     "{\"a\":1,}",
                           "{a:1}",    "{\"a\" 1}",
                           "[1 2]",    "nul",
                           "truex",    "True",
                           "NaN",      "-",
                           "01",       "-01",
                           "1.",       ".5",
                           "1e",       "1e+",
                           "+1",       "0x1",
                           "\"a",      "]",
                           "}",        ",",
                           "[}",       "{]",
                           "{\"a\":}", "{1:2}",
                           "'a'",      "[1,,2]",
                           "// c\n1",  "\xef\xbb\xbf{}",
                           "Infinity"}) {
    INFO(text);
    const int code = code_of(text);
    const bool refused = code == codes::kJsonSyntax.number || code == codes::kJsonTrailing.number;
    CHECK(refused);
  }
  CHECK(code_of("1 2") == codes::kJsonTrailing.number);
  CHECK(code_of("{}{}") == codes::kJsonTrailing.number);
  CHECK(code_of(std::string("{}\0", 3)) == codes::kJsonTrailing.number);
  CHECK(code_of("\"\n\"") == codes::kJsonBadString.number);
  CHECK(code_of("\"12345678\x1f\"") == codes::kJsonBadString.number);
  CHECK(code_of(R"("\x41")") == codes::kJsonBadString.number);
  CHECK(code_of(R"("\u12g4")") == codes::kJsonBadString.number);
  CHECK(code_of(R"("\ud800")") == codes::kJsonBadString.number);
  CHECK(code_of(R"("\udc00")") == codes::kJsonBadString.number);
  CHECK(code_of(R"("\ud800\u0041")") == codes::kJsonBadString.number);
  CHECK(code_of("\"\xff\"") == codes::kJsonBadUtf8.number);
  CHECK(code_of("\"\xc3\"") == codes::kJsonBadUtf8.number);
  CHECK(code_of("{\"\xed\xa0\x80\":1}") == codes::kJsonBadUtf8.number);
  CHECK(code_of("[1e999]") == codes::kJsonNumberRange.number);
  CHECK(code_of("-1e309") == codes::kJsonNumberRange.number);
  CHECK(code_of(std::string(400, '9')) == codes::kJsonNumberRange.number);
  CHECK(code_of(std::string(250, '9') + "e60") == codes::kJsonNumberRange.number);
  CHECK(code_of("1e308") == 0);
  CHECK(code_of("1e-99999999999999999999") == 0);
  CHECK(code_of("0e99999999999999999999") == 0);
}

TEST_CASE("base json: errors say where") {
  Diagnostics diagnostics;
  CHECK(!json::parse("{\n  \"a\": x}", "rig.glb", 20, diagnostics));
  CHECK(render(diagnostics, false) ==
        "rig.glb@0x1d: error[RIG0060]: expected a value, not \"x}\" (line 2, column 8 of the "
        "JSON)\n");
}

TEST_CASE("base json: duplicate keys") {
  const int duplicate = codes::kJsonDuplicateKey.number;
  CHECK(code_of(R"({"a":1,"b":2,"a":3})") == duplicate);
  CHECK(code_of(R"({"a":1,"\u0061":3})") == duplicate);
  CHECK(code_of(R"([{"x":{"a":1,"a":3}}])") == duplicate);
  CHECK(code_of(R"({"a":{"a":1},"b":{"a":1}})") == 0);
  std::string many = "{";
  for (int i = 0; i < 200'000; ++i) many += fmt::format("\"k{}\":{{}},", i);
  CHECK(code_of(many + "\"z\":1}") == 0);
  CHECK(code_of(many + "\"k\\u0031\":1}") == duplicate);
  CHECK(code_of(many + "\"k199999\":1}") == duplicate);
  // The first repetition in the text is the one that is named.
  Diagnostics diagnostics;
  CHECK(!json::parse(many + "\"k77\":1,\"k5\":1}", "x", 0, diagnostics));
  CHECK(diagnostics.all()[0].message.find("\"k77\"") != std::string::npos);
}

TEST_CASE("base json: nesting") {
  CHECK(code_of(repeat("[", 512) + repeat("]", 512)) == 0);
  CHECK(code_of(repeat("[", 513) + repeat("]", 513)) == codes::kJsonTooDeep.number);
  CHECK(code_of(repeat("[", 100'000)) == codes::kJsonTooDeep.number);
  CHECK(code_of(repeat("{\"a\":", 100'000)) == codes::kJsonTooDeep.number);
  const auto document = good(repeat("[1,", 511) + "[2]" + repeat("]", 511));
  json::Value value = document.root();
  for (int i = 0; i < 511; ++i) value = value.items()[1];
  CHECK(value.items()[0].pointer() == repeat("/1", 511) + "/0");
}

TEST_CASE("base json: many elements") {
  const auto document = good(fmt::format("[{}[]]", repeat("[1,2],", 300'000)));
  const auto items = document.root().items();
  std::size_t numbers = 0;
  for (const json::Value& item : items) numbers += item.items().size();
  CHECK(numbers == 600'000);
}

TEST_CASE("base json: a text that is too large") {
  CHECK(code_of(std::string((std::size_t{1} << 28) + 1, ' ')) == codes::kJsonTooLarge.number);
  CHECK(code_of("[" + repeat("0,", 4'000'000) + "0]") == codes::kJsonTooLarge.number);
}

TEST_CASE("base json: a moved document keeps its text") {
  auto first = good("[\"short\"]");
  const json::Document second = std::move(first);
  CHECK(second.root().items()[0].string() == "short");
}
