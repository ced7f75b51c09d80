// SPDX-License-Identifier: MIT
// Tests of src/base/diagnostics.h, span.h and codes.h: what users see of an error.
#include "base/diagnostics.h"

#include <doctest/doctest.h>

#include <set>

#include "base/codes.h"

using namespace rigc;

namespace {

constexpr Code kMistake{123, Severity::error, "a mistake", "help"};
constexpr Code kDoubt{124, Severity::warning, "a doubt", "help"};

std::string rendered(std::string text, Span span, std::string message = "wrong",
                     std::string hint = "") {
  Diagnostics diagnostics;
  span.file = diagnostics.sources().add("biped.yaml", std::move(text));
  diagnostics.report(kMistake, span, std::move(message), std::move(hint));
  return render(diagnostics, false);
}

}  // namespace

TEST_CASE("base diagnostics: place, line, caret and hint") {
  CHECK(rendered("rigc: 1\nnmae: biped\n", {0, 2, 1, 4}, "unknown key", "did you mean \"name\"?") ==
        "biped.yaml:2:1: error[RIG0123]: unknown key\n"
        "  nmae: biped\n"
        "  ^~~~\n"
        "  hint: did you mean \"name\"?\n");
  CHECK(rendered("a: 1", {0, 1, 4, 1}, "wrong", "one\ntwo") ==
        "biped.yaml:1:4: error[RIG0123]: wrong\n  a: 1\n     ^\n  hint: one\n        two\n");
}

TEST_CASE(
    "base diagnostics: tabs, wide characters and control characters keep the caret in place") {
  CHECK(rendered("\ta: x\r\n", {0, 1, 5, 1}) ==
        "biped.yaml:1:5: error[RIG0123]: wrong\n    a: x\n       ^\n");
  CHECK(rendered("\xc3\xa9: x", {0, 1, 5, 1}) ==
        "biped.yaml:1:5: error[RIG0123]: wrong\n  \xc3\xa9: x\n     ^\n");
  CHECK(rendered("\x1b[31mx", {0, 1, 6, 1},
                 "a\x1b"
                 "b\nc") ==
        "biped.yaml:1:6: error[RIG0123]: a\\x1bb\\x0ac\n  \\x1b[31mx\n          ^\n");
}

TEST_CASE("base diagnostics: long lines are cut around the caret") {
  std::string line(100'000, 'a');
  line[50'000] = '!';
  const std::string text = rendered(line, {0, 1, 50'001, 1});
  const std::size_t first = text.find('\n') + 1, second = text.find('\n', first) + 1;
  const std::string shown = text.substr(first, second - first - 1), caret = text.substr(second);
  CHECK(shown.size() < 180);
  CHECK(shown.starts_with("  ..."));
  CHECK(shown.ends_with("a..."));
  CHECK(shown.find('!') == caret.find('^'));
}

TEST_CASE("base diagnostics: spans outside their text do no harm") {
  CHECK(rendered("abc", {0, 99, 1, 1}) == "biped.yaml:99:1: error[RIG0123]: wrong\n");
  CHECK(rendered("abc", {0, 1, 99, 4'000'000'000u}) ==
        "biped.yaml:1:99: error[RIG0123]: wrong\n  abc\n     ^\n");
  CHECK(rendered("abc", {0, 0, 0, 0}) == "biped.yaml: error[RIG0123]: wrong\n");
  CHECK(rendered("", {0, 1, 1, 1}) == "biped.yaml:1:1: error[RIG0123]: wrong\n");
  Diagnostics diagnostics;
  diagnostics.report(kMistake, Span{7, 1, 1, 1}, "wrong");
  diagnostics.report(kMistake, Place(), "nowhere");
  CHECK(render(diagnostics, false) ==
        ":1:1: error[RIG0123]: wrong\nrigc: error[RIG0123]: nowhere\n");
}

TEST_CASE("base diagnostics: places in files") {
  const Sources sources;
  CHECK(describe(Place("rig.glb", "/nodes/3"), sources) == "rig.glb#/nodes/3");
  CHECK(describe(Place::at_byte("rig.glb", 16), sources) == "rig.glb@0x10");
  CHECK(describe(Place("a\nb"), sources) == "a\\x0ab");
}

TEST_CASE("base diagnostics: colour only when asked") {
  Diagnostics diagnostics;
  diagnostics.report(kDoubt, Place("a"), "hm", "look");
  CHECK(render(diagnostics, false).find('\x1b') == std::string::npos);
  CHECK(render(diagnostics, true).find("\x1b[1;35mwarning") != std::string::npos);
}

TEST_CASE("base diagnostics: at most a hundred are printed, with the total") {
  Diagnostics diagnostics;
  for (int i = 0; i < 100; ++i) diagnostics.report(kMistake, Place("a"), "wrong");
  CHECK(render(diagnostics, false).find("total") == std::string::npos);
  diagnostics.report(kDoubt, Place("a"), "hm");
  CHECK(render(diagnostics, false)
            .ends_with("wrong\n100 errors, 1 warning in total; the first 100 are shown\n"));
  CHECK(diagnostics.errors() == 100);
  CHECK(diagnostics.warnings() == 1);
}

TEST_CASE("base diagnostics: millions are counted, not kept") {
  Diagnostics diagnostics;
  for (int i = 0; i < 30'000; ++i) diagnostics.report(kMistake, Place("a"), "wrong");
  diagnostics.report(kDoubt, Place("a"), "hm");
  CHECK(diagnostics.errors() == 30'000);
  CHECK(diagnostics.all().size() == 10'001);
}

TEST_CASE("base diagnostics: the file system refused") {
  Diagnostics diagnostics;
  diagnostics.report(codes::kHardLink, Place("a"), "linked");
  diagnostics.report(codes::kFileTooLarge, Place("a"), "large");
  CHECK(!diagnostics.file_system_refused());
  diagnostics.report(codes::kCannotRead, Place("a"), "gone");
  CHECK(diagnostics.file_system_refused());
}

TEST_CASE("base diagnostics: names and texts stay where they are while sources grow") {
  Sources sources;
  const std::uint32_t file = sources.add("a", "x\r\ny");
  const std::string_view name = sources.name(file);
  for (int i = 0; i < 1000; ++i) sources.add("b", "");
  CHECK(name.data() == sources.name(file).data());
  CHECK(sources.line(file, 1) == "x");
  CHECK(sources.line(file, 2) == "y");
  CHECK(sources.line(file, 3) == "");
  CHECK(sources.line(file, 0) == "");
  CHECK(sources.text(0) == "");
  CHECK(sources.text(5000) == "");
}

TEST_CASE("base diagnostics: a copy of the sources shares texts and goes its own way") {
  Sources base;
  const Span span{base.add("shared.yaml", "one\ntwo"), 2, 1, 3};
  const std::string_view text = base.text(span.file);
  Diagnostics first(base), second(base);
  CHECK(first.sources().text(span.file).data() == text.data());
  CHECK(first.sources().add("first.yaml", "f") == second.sources().add("second.yaml", "s"));
  CHECK(first.sources().name(2) == "first.yaml");
  CHECK(second.sources().name(2) == "second.yaml");
  CHECK(base.name(2).empty());
  first.report(kMistake, span, "wrong");
  CHECK(render(first, false) == "shared.yaml:2:1: error[RIG0123]: wrong\n  two\n  ^~~\n");
}

TEST_CASE("base diagnostics: codes are unique and explained") {
  std::set<int> numbers;
  for (const Code* code : codes::base_codes) {
    CHECK(numbers.insert(code->number).second);
    CHECK((code->number >= 1 && code->number <= 99));
    CHECK(std::string(code->title).size() > 5);
    CHECK(std::string(code->help).ends_with("."));
  }
}
