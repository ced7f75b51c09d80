// SPDX-License-Identifier: MIT
// What changed from version to version: names, units, ranges, defaults; of parameters and of
// attributes; roles of modules that were succeeded.
#include "catalog/changes.h"

#include <doctest/doctest.h>

#include "catalog/codes.h"

using namespace rigc;
using namespace rigc::catalog;

namespace {

std::optional<Descriptor> read(const std::string& text, Diagnostics& diagnostics) {
  return read_descriptor(diagnostics.sources().add("swing.yaml", text), diagnostics);
}

/// A module at version 5 with these entries under `changes`, one a line.
std::string swing(const std::string& changes) {
  return R"(module: swing
version: 5
title: Swing
category: tests
summary: Swings.
parameters:
  - {name: blend, type: float, default: 1, min: 0, max: 10, help: H.}
  - {name: twist, type: angle, unit: degree, default: 90, help: H.}
  - {name: axis, type: vec3, default: [0, 0, 1], help: H.}
  - {name: steps, type: int, default: 3, help: H.}
  - {name: sizes, type: floats, optional: true, help: H.}
  - {name: output, type: expression, optional: true, help: H.}
  - {name: target, type: node, required: true, help: H.}
  - {name: word, type: string, default: x, help: H.}
creates:
  - {role: fk, kind: control, help: H.}
  - {role: zero, kind: transform, help: H.}
replaces: {fk_chain: {control: fk, fk.blend: -0.25}, old_chain: {handle: zero}}
changes:
)" + changes;
}

Descriptor good(const std::string& changes) {
  Diagnostics diagnostics;
  auto descriptor = read(swing(changes), diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(descriptor);
  return *descriptor;
}

int bad(const std::string& change) {
  CAPTURE(change);
  Diagnostics diagnostics;
  CHECK_FALSE(read(swing("  - {version: 3, " + change + "}\n"), diagnostics));
  REQUIRE(!diagnostics.all().empty());
  return diagnostics.all()[0].code->number;
}

std::string name_at(const Descriptor& descriptor, int version, const std::string& name) {
  const Parameter* found = parameter_at(descriptor, version, name);
  return found ? found->name : "-";
}

double now(const Descriptor& descriptor, int version, const std::string& name, double value) {
  Literal literal = Literal::of(value);
  convert(descriptor, *descriptor.find(name), version, literal);
  return literal.number;
}

}  // namespace

TEST_CASE("catalog changes: names are followed from every version") {
  const Descriptor two = good(
      "  - {version: 2, parameter: blend, was: mix}\n"
      "  - {version: 4, parameter: blend, was: ik_fk}\n");
  CHECK(name_at(two, 1, "mix") == "blend");
  CHECK(name_at(two, 2, "mix") == "-");
  CHECK(name_at(two, 2, "ik_fk") == "blend");
  CHECK(name_at(two, 3, "ik_fk") == "blend");
  CHECK(name_at(two, 4, "ik_fk") == "-");
  CHECK(name_at(two, 4, "blend") == "blend");
  CHECK(name_at(two, 1, "blend") == "blend");
  CHECK(name_at(two, 1, "nothing") == "-");
  // Two that exchanged their names, and a name that went from one to another.
  const Descriptor swapped = good(
      "  - {version: 3, parameter: blend, was: steps}\n"
      "  - {version: 3, parameter: steps, was: blend}\n"
      "  - {version: 4, parameter: twist, was: roll}\n"
      "  - {version: 2, parameter: word, was: roll}\n");
  CHECK(name_at(swapped, 2, "steps") == "blend");
  CHECK(name_at(swapped, 2, "blend") == "steps");
  CHECK(name_at(swapped, 3, "blend") == "blend");
  CHECK(name_at(swapped, 1, "roll") == "word");
  CHECK(name_at(swapped, 2, "roll") == "twist");
}

TEST_CASE("catalog changes: units are converted step by step") {
  const Descriptor d = good(
      "  - {version: 4, parameter: twist, offset: 10}\n"
      "  - {version: 2, parameter: twist, factor: 57.29577951308232}\n"
      "  - {version: 3, parameter: axis, factor: 0.01}\n"
      "  - {version: 3, parameter: steps, factor: 0.1}\n"
      "  - {version: 3, parameter: sizes, factor: 2, offset: 1}\n"
      "  - {version: 3, parameter: output, factor: 2, offset: -1}\n");
  CHECK(now(d, 1, "twist", 1.5707963267948966) == doctest::Approx(100).epsilon(1e-15));
  CHECK(now(d, 2, "twist", 90) == 100);
  CHECK(now(d, 4, "twist", 90) == 90);
  CHECK(now(d, 2, "steps", 30) == 3);  // not 3.0000000000000004
  CHECK(now(d, 2, "word", 7) == 7);
  Literal vector;
  vector.kind = Literal::Kind::list;
  vector.items = {Literal::of(100.0), Literal::of(0.0), Literal::of(-50.0)};
  convert(d, *d.find("axis"), 1, vector);
  CHECK(vector.items[0].number == 1);
  CHECK(vector.items[2].number == -0.5);
  CHECK(vector.items[2].text == "-0.5");
  Literal expression = Literal::of("{a@x} + 1");
  convert(d, *d.find("output"), 2, expression);
  CHECK(expression.text == "(({a@x} + 1) * 2) + -1");
  convert(d, *d.find("output"), 3, expression);
  CHECK(expression.text == "(({a@x} + 1) * 2) + -1");
}

TEST_CASE("catalog changes: values of an earlier range are brought into today's, others are left") {
  const Descriptor d = good("  - {version: 3, parameter: blend, factor: 10, max_was: 2}\n");
  const auto converted = [&](double value) {
    Literal literal = Literal::of(value);
    const bool clamped = convert(d, *d.find("blend"), 2, literal);
    return std::pair(literal.number, clamped);
  };
  CHECK(converted(0.5) == std::pair(5.0, false));
  CHECK(converted(1.5) == std::pair(10.0, true));
  CHECK(converted(2.5) == std::pair(25.0, false));   // never was allowed
  CHECK(converted(-0.5) == std::pair(-5.0, false));  // the smallest value did not change
}

TEST_CASE("catalog changes: defaults of earlier versions in today's terms") {
  const Descriptor d = good(
      "  - {version: 2, parameter: twist, factor: 2}\n"
      "  - {version: 3, parameter: twist, default_was: 30}\n"
      "  - {version: 4, parameter: twist, factor: 3}\n"
      "  - {version: 5, parameter: twist, default_was: 45}\n"
      "  - {version: 3, parameter: target, default_was: '..'}\n");
  const auto at = [&](const char* name, int version) {
    const auto found = default_at(d, *d.find(name), version);
    return found ? found->kind == Literal::Kind::text ? found->text : found->text : "-";
  };
  CHECK(at("twist", 1) == "90");
  CHECK(at("twist", 2) == "90");
  CHECK(at("twist", 3) == "45");
  CHECK(at("twist", 4) == "45");
  CHECK(at("twist", 5) == "-");
  CHECK(at("target", 2) == "..");
  CHECK(at("blend", 1) == "-");
}

TEST_CASE("catalog changes: attributes of controls, and roles of modules that were succeeded") {
  const Descriptor d = good(
      "  - {version: 2, attribute: blend, was: mix, factor: 0.1}\n"
      "  - {version: 3, attribute: blend, was: ik_fk, factor: 2, offset: 1}\n"
      "  - {version: 4, attribute: roll, factor: -1}\n"
      "  - {version: 3, parameter: blend, was: mix}\n");
  using Changes = std::vector<AttributeChange>;
  CHECK(attribute_changes(d, 1) == Changes{{"mix", "blend", 0.2, 1}, {"roll", "roll", -1, 0}});
  CHECK(attribute_changes(d, 2) == Changes{{"ik_fk", "blend", 2, 1}, {"roll", "roll", -1, 0}});
  CHECK(attribute_changes(d, 3) == Changes{{"roll", "roll", -1, 0}});
  CHECK(attribute_changes(d, 4).empty());
  CHECK(attribute_changes(d, 9).empty());
  CHECK(replaced_role(d, "fk_chain", "control") == "fk");
  CHECK(replaced_role(d, "old_chain", "handle") == "zero");
  CHECK_FALSE(replaced_role(d, "fk_chain", "handle"));
  CHECK_FALSE(replaced_role(d, "new_chain", "control"));
  CHECK(values_as(d, "fk_chain") == std::vector<AttributeValue>{{"fk", "blend", -0.25}});
  CHECK(values_as(d, "old_chain").empty());
  CHECK(values_as(d, "new_chain").empty());
}

TEST_CASE("catalog changes: entries are checked") {
  const int change = codes::kBadChange.number, conversion = codes::kBadConversion.number;
  CHECK(bad("parameter: gone") == change);
  CHECK(bad("parameter: blend, attribute: blend") == change);
  CHECK(bad("was: mix") == change);
  CHECK(bad("factor: 2") == change);
  CHECK(bad("attribute: roll, default_was: 2") == change);
  CHECK(bad("attribute: roll, max_was: 2") == change);
  CHECK(bad("attribute: roll, was: roll") == change);
  CHECK(bad("parameter: blend, factor: 0") == conversion);
  CHECK(bad("parameter: word, factor: 2") == conversion);
  CHECK(bad("parameter: word, offset: 2") == conversion);
  CHECK(bad("parameter: twist, max_was: 2") == conversion);  // has no range now
  CHECK(bad("parameter: blend, min_was: 3, max_was: 2") == conversion);
  CHECK(bad("parameter: blend, default_was: 11") == codes::kBadDefault.number);
  CHECK(bad("parameter: blend, default_was: 6, factor: 2") == codes::kBadDefault.number);
  CHECK(bad("parameter: blend, was: mix}\n  - {version: 3, parameter: twist, was: mix") ==
        codes::kSameEarlierName.number);
  CHECK(bad("attribute: blend, was: mix}\n  - {version: 3, attribute: twist, was: mix") ==
        codes::kSameEarlierName.number);
  CHECK(good("  - {version: 2, attribute: blend, was: mix}\n"
             "  - {version: 2, parameter: blend, was: mix}\n"
             "  - {version: 3, parameter: twist, was: mix}\n"
             "  - {version: 5, note: Other curves.}\n")
            .changes.size() == 4);
}

TEST_CASE("catalog changes: in words") {
  const Descriptor d = good(
      "  - {version: 3, parameter: blend, was: mix, factor: 10, default_was: 0.5, max_was: 2,"
      " min_was: 0}\n"
      "  - {version: 4, attribute: roll, offset: 1, note: Turned.}\n"
      "  - {version: 5, note: Other curves.}\n");
  CHECK(describe(d.changes[0]) ==
        "version 3: blend was called mix, values times 10, had the default 0.5, went down to 0, "
        "went up to 2");
  CHECK(describe(d.changes[1]) == "version 4: attribute roll values plus 1, Turned.");
  CHECK(describe(d.changes[2]) == "version 5: Other curves.");
}
