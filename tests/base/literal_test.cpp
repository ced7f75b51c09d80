// SPDX-License-Identifier: MIT
// Tests of src/base/literal.h.
#include "base/literal.h"

#include <doctest/doctest.h>

#include "base/codes.h"

using namespace rigc;

namespace {

std::optional<Literal> from_yaml(const std::string& text, Diagnostics& diagnostics) {
  const auto node = yaml::read(diagnostics.sources().add("x.yaml", text), diagnostics);
  REQUIRE(node);
  return literal_from(*node, diagnostics);
}

}  // namespace

TEST_CASE("base literal: kinds follow from the spelling") {
  Diagnostics diagnostics;
  const auto all =
      from_yaml("{a: on, b: 1.50, c: '1', d: ~, e: [x, {f: off}], g: True}", diagnostics);
  REQUIRE(all);
  CHECK(*all->find("a") == Literal::of(true));
  CHECK(*all->find("b") == Literal::of(1.5));
  CHECK(all->find("b")->text == "1.50");
  CHECK(*all->find("c") == Literal::of("1"));
  CHECK(all->find("d")->kind == Literal::Kind::null);
  CHECK(all->find("e")->items[0] == Literal::of("x"));
  CHECK(*all->find("e")->items[1].find("f") == Literal::of(false));
  CHECK(*all->find("g") == Literal::of("True"));
  CHECK(all->find("z") == nullptr);
  CHECK(all->find("b")->span.column == 12);
  CHECK(!(Literal::of("1") == Literal::of(1.0)));
}

TEST_CASE("base literal: yes and no are reported, every one") {
  Diagnostics diagnostics;
  CHECK(!from_yaml("{a: yes, b: [no, 'no']}", diagnostics));
  CHECK(diagnostics.errors() == 2);
  CHECK(diagnostics.all()[0].code->number == codes::kNotABoolean.number);
}

TEST_CASE("base literal: JSON and back") {
  Diagnostics diagnostics;
  const auto literal =
      from_yaml("{a: on, b: 1.50, c: \"x\\n\", d: ~, e: [1e300, [], {}]}", diagnostics);
  REQUIRE(literal);
  json::Writer writer;
  write(writer, *literal);
  CHECK(writer.text() == R"({"a":true,"b":1.5,"c":"x\n","d":null,"e":[1e+300,[],{}]})");
  const auto document = json::parse(writer.take(), "x", 0, diagnostics);
  REQUIRE(document);
  CHECK(literal_from(document->root()) == literal);
  CHECK(!literal_from(json::Value()));
}
