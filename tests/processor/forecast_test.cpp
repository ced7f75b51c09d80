// SPDX-License-Identifier: MIT
// A selector that names what does not exist yet is told which later command would make it, and
// where; one that nothing will ever make is not.
#include "processor/forecast.h"

#include <doctest/doctest.h>

#include "support/rig.h"

using namespace rigc;

namespace {

/// The hint of the one error of a template whose first joint `a` holds the failing `set` command;
/// `later` are the tags of joint `b` below it. The set runs in stage build, before b's commands.
std::string hint(const std::string& plug, const std::string& later) {
  const test::Rig rig(
      test::template_of("joints:\n"
                        "  - name: a\n"
                        "    at: [0, 0, 0]\n"
                        "    local: arm\n"
                        "    label: upper\n"
                        "    tags:\n"
                        "      - {command: set, stage: build, with: {plug: \"" +
                        plug +
                        "\", value: 1}}\n"
                        "  - name: b\n"
                        "    parent: a\n"
                        "    at: [0, 1, 0]\n"
                        "    local: arm\n"
                        "    label: lower\n"
                        "    tags:\n" +
                        later));
  INFO(plug << "\n" << test::text(rig.diagnostics));
  REQUIRE(test::codes(rig.diagnostics) == "RIG0420");
  return rig.diagnostics.all().front().hint;
}

const std::string kControl = "      - {command: control, with: {}}\n";
const std::string kControl2 = "      - {command: control, id: second}\n";
const std::string kLater =
    "made by \"control\" on joint \"b\", which runs later, test.yaml:17; "
    "give that command an earlier stage or this one a later";

}  // namespace

TEST_CASE("processor forecast: a later command is named with its line") {
  CHECK(hint("arm.lower/control@translate.x", kControl) == kLater);
  CHECK(hint("arm/control@translate.x", kControl) == kLater);
  CHECK(hint("arm.lower/*@translate.x", kControl) == kLater);
  CHECK(hint("arm.lower/control#control.zero@translate.x", kControl) == kLater);
  CHECK(hint("arm[END]/control@translate.x", kControl) == kLater);
}

TEST_CASE("processor forecast: a command that makes nodes for other joints is found by them") {
  const std::string chain = "      - {command: fk_chain, with: {joints: [arm.upper, .]}}\n";
  CHECK(hint("./fk_chain@rotate.x", chain).find("made by \"fk_chain\" on joint \"b\"") == 0);
}

TEST_CASE("processor forecast: a label that a later command gives is found") {
  const std::string tip = "      - {command: transform, id: tip, with: {local: arm, label: tip}}\n";
  CHECK(hint("arm.tip@translate.x", tip).find("made by \"tip\" on joint \"b\"") == 0);
  CHECK(hint("arm.tip/transform@translate.x", tip).find("made by \"tip\" on joint \"b\"") == 0);
}

TEST_CASE("processor forecast: a command that is switched off is named too") {
  CHECK(hint("arm.lower/control@translate.x", "      - {command: control, on: off}\n") ==
        "made by \"control\" on joint \"b\", which is switched off, test.yaml:17");
  CHECK(hint("arm/control@translate.x", "      - {command: control, on: off}\n" + kControl2) ==
        "made by \"second\" on joint \"b\", which runs later, test.yaml:18; "
        "give that command an earlier stage or this one a later");
}

TEST_CASE("processor forecast: nothing is promised that will not come") {
  CHECK(hint("arm.upper/control@translate.x", kControl) == "nothing has been made there yet");
  CHECK(hint("./control@translate.x", kControl) == "nothing has been made there yet");
  CHECK(hint("arm.lower/control#other@translate.x", kControl) == "nothing has been made there yet");
  CHECK(hint("arm.lower/control.pole@translate.x", kControl) == "nothing has been made there yet");
  CHECK(hint("arm.lower/root@translate.x", kControl) == "nothing has been made there yet");
  CHECK(hint("arm.tip@translate.x", kControl).find("has no label \"tip\"") != std::string::npos);
}
