// SPDX-License-Identifier: MIT
// Tests of the writer in src/base/json.h.
#include <doctest/doctest.h>

#include "base/json.h"

using namespace rigc;

namespace {

void write_sample(json::Writer& writer) {
  const double numbers[] = {0, -0.0, 0.1, 1e300};
  writer.begin_object();
  writer.member("name", "a\"b").member("count", std::size_t{3}).member("on", true);
  writer.key("empty").begin_array().end_array();
  writer.key("none").begin_object().end_object();
  writer.key("n").numbers(numbers, 4);
  writer.key("list").begin_array().value(1).value(-2.5).integer(7).end_array();
  writer.key("words").begin_array().value("x").null().raw("{\"r\":1}").end_array();
  writer.end_object();
}

}  // namespace

TEST_CASE("base json writer: one line") {
  json::Writer writer;
  write_sample(writer);
  CHECK(writer.take() ==
        R"({"name":"a\"b","count":3,"on":true,"empty":[],"none":{},"n":[0,0,0.1,1e+300],)"
        R"("list":[1,-2.5,7],"words":["x",null,{"r":1}]})");
}

TEST_CASE("base json writer: indented, with short arrays of numbers on one line") {
  json::Writer writer(2);
  write_sample(writer);
  CHECK(writer.text() ==
        "{\n  \"name\": \"a\\\"b\",\n  \"count\": 3,\n  \"on\": true,\n  \"empty\": [],\n"
        "  \"none\": {},\n  \"n\": [0, 0, 0.1, 1e+300],\n  \"list\": [1, -2.5, 7],\n"
        "  \"words\": [\n    \"x\",\n    null,\n    {\"r\":1}\n  ]\n}");
}

TEST_CASE("base json writer: long arrays of numbers stay in lines, and nested ones parse") {
  json::Writer writer(1);
  writer.begin_array();
  for (int i = 0; i < 3; ++i) {
    writer.begin_array();
    for (int j = 0; j < 10 * i * i; ++j) writer.value(j);
    writer.end_array();
  }
  writer.end_array();
  CHECK(writer.text().starts_with("[\n [],\n [0, 1, 2, 3, 4, 5, 6, 7, 8, 9],\n [\n  0,\n  1,"));
  Diagnostics diagnostics;
  const auto document = json::parse(writer.take(), "x", 0, diagnostics);
  REQUIRE(document);
  CHECK(document->root().items()[2].size() == 40);
}

TEST_CASE("base json writer: strings") {
  CHECK(json::quote("") == "\"\"");
  CHECK(json::quote("\n\r\t\x01\x1f\\\"/") == "\"\\n\\r\\t\\u0001\\u001f\\\\\\\"/\"");
  CHECK(json::quote("\xc3\xa9") == "\"\xc3\xa9\"");
  CHECK(json::quote("\xff") == "\"\\\\xff\"");
  std::string bytes;
  for (int i = 0; i < 128; ++i) bytes += static_cast<char>(i);
  Diagnostics diagnostics;
  const auto document = json::parse(json::quote(bytes), "x", 0, diagnostics);
  REQUIRE(document);
  CHECK(document->root().string() == bytes);
}

TEST_CASE("base json writer: long lists are written in linear time") {
  json::Writer writer(2);
  writer.begin_array();
  for (int i = 0; i < 500'000; ++i) writer.begin_array().value(i).end_array();
  writer.end_array();
  CHECK(writer.text().size() > 500'000);
}
