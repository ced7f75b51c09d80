// SPDX-License-Identifier: MIT
// Commands that were written for earlier versions of their modules: of templates that pin them, and
// of rigs.
#include <doctest/doctest.h>

#include "templates/arguments.h"
#include "templates/codes.h"
#include "templates/library.h"
#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

/// A module whose size was a diameter called `width`, whose axis was in centimetres, and whose
/// defaults were others.
constexpr const char* kKnob = R"(module: knob
version: 4
title: Knob
category: tests
summary: A control.
implementation: control
parameters:
  - {name: size, type: length, default: 0.5, min: 0.01, max: 1, help: H.}
  - {name: axis, type: vec3, side: signed, default: [1, 0, 0], help: H.}
  - {name: drive, type: expression, default: 1, help: H.}
  - {name: target, type: node, required: true, help: H.}
creates:
  - {role: control, kind: control, help: H.}
changes:
  - {version: 2, parameter: size, was: width, factor: 0.5}
  - {version: 2, parameter: axis, factor: 0.01, default_was: [0, 200, 0]}
  - {version: 3, parameter: size, default_was: 0.25, max_was: 4}
  - {version: 3, parameter: target, was: goal, default_was: "."}
  - {version: 4, parameter: axis, default_was: [0, 3, 0]}
  - {version: 4, parameter: drive, factor: 2}
)";

struct Workshop {
  Folder modules{"changes_modules"}, folder{"changes_templates"};
  catalog::Catalogue catalogue;
  Diagnostics diagnostics;

  Workshop() {
    modules.write("knob.yaml", kKnob);
    const bool added = catalogue.add_folder(modules.path(), diagnostics);
    INFO(render(diagnostics, false));
    REQUIRE(added);
  }
  const catalog::Descriptor& knob() const { return *catalogue.find("knob"); }

  std::optional<Expanded> expand(const std::string& text) {
    Library library({folder.path()}, catalogue);
    const Template* main = library.open(folder.write("main.yaml", text), diagnostics);
    if (!main) return std::nullopt;
    return templates::expand(*main, library, catalogue, diagnostics);
  }
  /// The arguments of the only command of a joint `a` that is written like this.
  std::string arguments(const std::string& pins, const std::string& with,
                        const std::string& more = {}) {
    const auto expanded = expand(with_head(
        pins + more + "joints:\n  - name: a\n    tags: [{command: knob, with: " + with + "}]\n"));
    INFO(render(diagnostics, false));
    REQUIRE(expanded);
    return told(expanded->joints.at(0).tagged.commands.at(0));
  }
  static std::string told(const tags::CommandTag& command) {
    json::Writer writer;
    writer.begin_object();
    for (const tags::Argument& argument : command.with) {
      writer.key(argument.name);
      write(writer, argument.value);
    }
    return writer.end_object().take();
  }
};

}  // namespace

TEST_CASE("templates changes: without a pin a template speaks today's language") {
  Workshop w;
  CHECK(w.arguments("", "{size: 0.3, target: .}") == R"({"size":0.3,"target":"."})");
  CHECK(w.arguments("modules: {knob: 4}\n", "{target: .}") == R"({"target":"."})");
  CHECK(w.diagnostics.all().empty());
  CHECK_FALSE(
      w.expand(with_head("joints: [{name: a, tags: [{command: knob, with: {width: 1}}]}]")));
  CHECK(w.diagnostics.all()[0].code->number == codes::kUnknownArgument.number);
}

TEST_CASE("templates changes: a pinned template keeps names, units and defaults of its version") {
  Workshop w;
  CHECK(w.arguments("modules: {knob: 1}\n", "{width: 0.6, drive: \"{./control@x}\"}") ==
        R"({"size":0.3,"drive":"({./control@x}) * 2","axis":[0,2,0],"target":"."})");
  CHECK(w.arguments("modules: {knob: 2}\n", "{size: 0.6, goal: \"..\", axis: [1, 2, 3]}") ==
        R"({"size":0.6,"target":"..","axis":[1,2,3]})");
  CHECK(w.arguments("modules: {knob: 3}\n", "{target: ., drive: 3}") ==
        R"({"target":".","drive":6,"axis":[0,3,0]})");
  CHECK(w.arguments(
            "modules: {knob: 1}\n", "{width: $w, goal: $t}",
            "parameters: {w: {type: length, default: 0.8}, t: {type: string, default: .}}\n") ==
        R"({"size":0.4,"target":".","axis":[0,2,0]})");
  CHECK(w.arguments("modules: {knob: 1}\nunits: centimetre\n", "{width: 60}") ==
        R"({"size":0.3,"axis":[0,2,0],"target":"."})");
  CHECK(w.diagnostics.all().empty());
}

TEST_CASE("templates changes: pins are those of the template that has the command") {
  Workshop w;
  w.folder.write("old.yaml", with_head("modules: {knob: 1}\njoints: [{name: b, tags: "
                                       "[{command: knob, with: {axis: [100, 0, 0]}}]}]\n",
                                       "old"));
  const auto expanded = w.expand(
      with_head("joints: [{name: a, at: [0, 0, 0], tags: [{command: knob, with: {target: .}}]}]\n"
                "parts: [{template: old, as: l, attach: a}, {template: old, as: r, attach: a, "
                "mirror: x}]\n"));
  INFO(render(w.diagnostics, false));
  REQUIRE(expanded);
  const auto& joints = expanded->joints;
  REQUIRE(joints.size() == 3);
  CHECK(Workshop::told(joints[0].tagged.commands[0]) == R"({"target":"."})");
  CHECK(Workshop::told(joints[1].tagged.commands[0]) ==
        R"({"axis":[1,0,0],"size":0.25,"target":"."})");
  // What is written is mirrored, a default is the same on both sides.
  CHECK(Workshop::told(joints[2].tagged.commands[0]) ==
        R"({"axis":[-1,0,0],"size":0.25,"target":"."})");
}

TEST_CASE("templates changes: what no longer fits is told") {
  Workshop w;
  CHECK(w.arguments("modules: {knob: 1}\n", "{width: 3}") ==
        R"({"size":1,"axis":[0,2,0],"target":"."})");
  REQUIRE(numbers(w.diagnostics) == std::vector<int>{codes::kClamped.number});
  CHECK(w.diagnostics.all()[0].hint == "1 is used");
  Workshop never;
  CHECK_FALSE(never.expand(with_head(
      "modules: {knob: 1}\njoints: [{name: a, tags: [{command: knob, with: {width: 9}}]}]")));
  CHECK(numbers(never.diagnostics) == std::vector<int>{codes::kArgumentValue.number});
  Workshop twice;
  CHECK_FALSE(
      twice.expand(with_head("modules: {knob: 1}\njoints: [{name: a, tags: [{command: "
                             "knob, with: {width: 0.5, size: 0.5}}]}]")));
  CHECK(numbers(twice.diagnostics) == std::vector<int>{codes::kArgumentTwice.number});
}

TEST_CASE("templates changes: commands of rigs are brought to the present version") {
  Workshop w;
  tags::CommandTag command;
  command.module = "knob";
  command.with = {{"width", {}, Literal::of(0.6)},
                  {"gone", {}, Literal::of(1.0)},
                  {"label", {}, Literal::of("k")}};
  CHECK(upgrade(w.knob(), 1, command, w.diagnostics));
  CHECK(Workshop::told(command) == R"({"size":0.3,"label":"k","axis":[0,2,0],"target":"."})");
  CHECK(numbers(w.diagnostics) == std::vector<int>{codes::kArgumentGone.number});
  const tags::CommandTag once = command;
  CHECK(upgrade(w.knob(), 4, command, w.diagnostics));
  CHECK(command.with == once.with);
  command.with = {{"target", {}, Literal::of(3.0)}};
  CHECK_FALSE(upgrade(w.knob(), 3, command, w.diagnostics));
}
