// SPDX-License-Identifier: MIT
// Tests of src/catalog/descriptor.cpp and parameters.cpp: what is read, what is refused and where.
#include "catalog/descriptor.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/codes.h"
#include "base/text.h"
#include "catalog/codes.h"

using namespace rigc;
using namespace rigc::catalog;

namespace {

const std::string kHead =
    "module: swing\nversion: 2\ntitle: Swing\ncategory: basics\nsummary: Swings.\n";

std::string with_parameter(const std::string& parameter) {
  return kHead + "parameters:\n  - {help: H., " + parameter + "}\n";
}

std::optional<Descriptor> read(const std::string& text, Diagnostics& diagnostics) {
  return read_descriptor(diagnostics.sources().add("modules.d/swing.yaml", text), diagnostics);
}

Descriptor good(const std::string& text) {
  Diagnostics diagnostics;
  const auto descriptor = read(text, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(descriptor);
  return *descriptor;
}

/// Exactly one error of this code, in the line where `mark` stands.
void bad(const std::string& text, const Code& code, const std::string& mark) {
  Diagnostics diagnostics;
  CAPTURE(text);
  CHECK(!read(text, diagnostics));
  INFO(render(diagnostics, false));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == code.number);
  const auto before = text.substr(0, text.find(mark));
  const auto line = static_cast<std::uint32_t>(std::count(before.begin(), before.end(), '\n') + 1);
  CHECK(diagnostics.all()[0].place.span.line == line);
}

}  // namespace

TEST_CASE("catalog descriptor: a whole one") {
  const Descriptor swing = good(kHead + R"(stage: finish
help: Longer.
implementation: control
parameters:
  - {name: before, type: bool, default: off, help: No frame.}
  - frame: Chain
  - {name: start_joint, type: node, kind: joint, required: true, help: First.}
  - frame: Motion
  - {name: speed, type: float, default: 1.5, min: 0, max: 10, side: signed, help: How fast.}
  - {name: ik_mode, type: enum, values: [soft, hard], default: hard, title: Mode, help: How.}
  - {name: pole, type: node, optional: true, help: None if left out.}
creates:
  - {role: fk, kind: control, per: joint, help: One each.}
  - {role: zero, kind: transform, help: Rest.}
replaces: {pendulum: {control: fk}}
changes:
  - {version: 2, parameter: speed, was: velocity, default_was: 2, note: Renamed.}
example: |
  rigc: 1
)");
  CHECK(swing.module == "swing");
  CHECK(swing.version == 2);
  CHECK(swing.stage == Stage::finish);
  CHECK(swing.implementation == "control");
  CHECK(swing.example == "rigc: 1\n");
  REQUIRE(swing.parameters.size() == 5);
  CHECK(swing.parameters[0].frame.empty());
  CHECK(*swing.parameters[0].default_value == Literal::of(false));
  const Parameter& start = *swing.find("start_joint");
  CHECK(start.frame == "Chain");
  CHECK(start.title == "Start joint");
  CHECK(start.kind == "joint");
  CHECK(start.required);
  CHECK(!start.optional());
  const Parameter& speed = *swing.find("speed");
  CHECK(speed.frame == "Motion");
  CHECK(speed.is_signed);
  CHECK(*speed.max == 10);
  CHECK(swing.find("ik_mode")->title == "Mode");
  CHECK(swing.find("pole")->optional());
  CHECK(swing.find("none") == nullptr);
  CHECK(swing.makes_nodes());
  CHECK(swing.creates[0].per == "joint");
  CHECK(swing.creates[1].per == "command");
  CHECK(swing.replaces[0].second[0] == std::pair<std::string, std::string>("control", "fk"));
  CHECK(swing.changes[0].was == "velocity");
  CHECK(*swing.changes[0].default_was == Literal::of(2.0));
}

TEST_CASE("catalog descriptor: titles come from names") {
  CHECK(good(with_parameter("name: ik_size, type: float, default: 1")).parameters[0].title ==
        "IK size");
}

TEST_CASE("catalog descriptor: the head is checked") {
  bad("version: 1\ntitle: T\ncategory: c\nsummary: S\n", catalog::codes::kMissingKey, "version");
  bad("module: swing\ntitle: T\ncategory: c\nsummary: S\n", catalog::codes::kMissingKey, "module");
  bad("module: swing\nversion: 1\ntitle: ' '\ncategory: c\nsummary: S\n",
      catalog::codes::kMissingKey, "title");
  bad("module: swing\nversion: 0\ntitle: T\ncategory: c\nsummary: S\n", catalog::codes::kBadVersion,
      "version");
  bad("module: other\nversion: 1\ntitle: T\ncategory: c\nsummary: S\n",
      catalog::codes::kWrongFileName, "other");
  bad(kHead + "stage: late\n", catalog::codes::kUnknownWord, "late");
  bad(kHead + "colour: red\n", rigc::codes::kUnknownKey, "colour");
  bad(kHead + "parameters: 3\n", rigc::codes::kNotASequence, "parameters");
  bad(kHead + "implementation: [a]\n", rigc::codes::kNotAName, "implementation");
  bad("- a\n", rigc::codes::kNotAMap, "- a");
}

TEST_CASE("catalog descriptor: parameters are checked") {
  bad(with_parameter("name: a, default: 1"), catalog::codes::kMissingKey, "default");
  bad(with_parameter("type: float, default: 1"), catalog::codes::kMissingKey, "default");
  bad(with_parameter("name: a, type: flaot, default: 1"), catalog::codes::kUnknownWord, "flaot");
  bad(with_parameter("name: a, type: float, default: 1, colour: 2"), rigc::codes::kUnknownKey,
      "colour");
  bad(with_parameter("name: a, type: float"), catalog::codes::kPresence, "float");
  bad(with_parameter("name: a, type: float, default: 1, required: true"), catalog::codes::kPresence,
      "required");
  bad(with_parameter("name: a, type: float, optional: off"), catalog::codes::kPresence, "optional");
  bad(with_parameter("name: a, type: float, default: x"), catalog::codes::kBadDefault, "default");
  bad(with_parameter("name: a, type: float, default: 3, max: 2"), catalog::codes::kBadDefault,
      "default");
  bad(with_parameter("name: a, type: enum, values: [x1, x2], default: x3"),
      catalog::codes::kBadDefault, "x3");
  bad(with_parameter("name: a, type: float, default: 1, min: 3, max: 2"), catalog::codes::kBadRange,
      "min");
  bad(with_parameter("name: a, type: string, default: x, min: 1"), catalog::codes::kWrongKeyForType,
      "min");
  bad(with_parameter("name: a, type: float, default: 1, values: [p, q]"),
      catalog::codes::kWrongKeyForType, "values");
  bad(with_parameter("name: a, type: plug, required: true, kind: joint"),
      catalog::codes::kWrongKeyForType, "kind");
  bad(with_parameter("name: a, type: node, required: true, side: signed"),
      catalog::codes::kWrongKeyForType, "side");
  bad(with_parameter("name: a, type: float, default: 1, side: left"), catalog::codes::kUnknownWord,
      "left");
  bad(with_parameter("name: a, type: enum, default: x"), catalog::codes::kMissingKey, "enum");
  bad(with_parameter("name: a, type: enum, values: [x], default: x"), catalog::codes::kBadValues,
      "values");
  bad(with_parameter("name: a, type: enum, values: [x, x, y], default: x"),
      catalog::codes::kBadValues, "values");
  bad(with_parameter("name: a, type: enum, values: [x, off, y], default: x"),
      catalog::codes::kBadValues, "values");
  const std::string two = "parameters:\n  - {name: a, type: bool, default: on, help: H.}\n";
  bad(kHead + two + "  - {name: a, type: int, default: 1, help: H.}\n",
      catalog::codes::kDuplicateParameter, "type: int");
  bad(kHead + "parameters:\n  - frame: F\n  - frame: G\n  - frame: F\n\n",
      catalog::codes::kDuplicateFrame, "F\n\n");
}

TEST_CASE("catalog descriptor: makers of nodes cannot declare what they take anyhow") {
  const std::string made = "creates: [{role: zero, kind: transform, help: H.}]\n";
  bad(made + with_parameter("name: label, type: string, optional: true"),
      catalog::codes::kReservedParameter, "label");
  CHECK(good(with_parameter("name: label, type: string, optional: true")).find("label"));
  CHECK(is_creation_parameter("name"));
  CHECK(is_creation_parameter("local"));
  CHECK(!is_creation_parameter("global"));
}

TEST_CASE("catalog descriptor: creates, replaces and changes are checked") {
  const std::string made = "creates:\n  - {role: fk, kind: control, help: H.}\n";
  bad(kHead + made + "  - {role: fk, kind: control, help: Again.}\n",
      catalog::codes::kDuplicateCreates, "Again");
  CHECK(good(kHead + made + "  - {role: fk, kind: transform, help: H.}\n").creates.size() == 2);
  bad(kHead + "creates: [{role: fk, kind: control}]\n", catalog::codes::kMissingKey, "creates");
  bad(kHead + "creates: [{role: fk, kind: control, per: rig, help: H.}]\n",
      catalog::codes::kUnknownWord, "per");
  bad(kHead + made + "replaces: {old: {control: kf}}\n", catalog::codes::kBadReplaces, "kf");
  bad(kHead + made + "replaces: {old: {kf.blend: 1}}\n", catalog::codes::kBadReplaces, "1");
  bad(kHead + made + "replaces: {old: {fk.blend: most}}\n", rigc::codes::kNotANumber, "most");
  bad(kHead + made + "replaces: {old: 3}\n", rigc::codes::kNotAMap, "old");
  bad(kHead + "changes: [{version: 3, note: N}]\n", catalog::codes::kBadChange, "changes");
  bad(kHead + "changes: [{note: N}]\n", catalog::codes::kMissingKey, "changes");
  bad(kHead + "changes: [{version: 2, parameter: gone}]\n", catalog::codes::kBadChange, "gone");
  bad(with_parameter("name: a, type: float, default: 1") +
          "changes: [{version: 2, parameter: a, default_was: x}]\n",
      catalog::codes::kBadDefault, "default_was");
}

TEST_CASE("catalog descriptor: all errors are reported at once") {
  Diagnostics diagnostics;
  CHECK(!read(kHead + "stage: late\nparameters:\n  - {name: a, type: flaot}\n  - {name: b}\n",
              diagnostics));
  CHECK(diagnostics.errors() == 5);  // stage, help twice, type twice
}

TEST_CASE("catalog descriptor: every key has a test for a wrong type") {
  const std::string full = kHead +
                           "stage: build\nhelp: H\nimplementation: a\nexample: E\n"
                           "parameters: []\ncreates: []\nreplaces: {}\nchanges: []\n";
  CHECK(good(full).example == "E");
  for (const char* key :
       {"module", "version", "title", "category", "summary", "stage", "help", "implementation",
        "example", "parameters", "creates", "replaces", "changes"}) {
    CAPTURE(key);
    const std::size_t begin = full.find(std::string(key) + ":");
    const std::size_t end = full.find('\n', begin);
    std::string text = full;
    text.replace(begin, end - begin, std::string(key) + ": [{a: [b]}, 1]");
    Diagnostics diagnostics;
    CHECK(!read(text, diagnostics));
    CHECK(diagnostics.errors() >= 1);
  }
}
