// SPDX-License-Identifier: MIT
// Tests of src/selector/parse.cpp: what is read, what is refused and where the caret stands.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "selector/codes.h"
#include "selector/random_selector_helpers.h"
#include "selector/selector.h"

using namespace rigc;
using namespace rigc::selector;

namespace {

Selector good(const std::string& text) {
  Diagnostics diagnostics;
  const auto selector =
      parse(text, Span{diagnostics.sources().add("t", text), 1, 1, 1}, diagnostics);
  INFO(text, "\n", render(diagnostics, false));
  REQUIRE(selector);
  CHECK(diagnostics.all().empty());
  return *selector;
}

/// One choice whose text comes back as it was.
Choice choice(const std::string& text) {
  const Selector selector = good(text);
  REQUIRE(selector.choices.size() == 1);
  CHECK(print(selector) == text);
  return selector.choices[0];
}

struct Bad {
  const char* text;
  const Code& code;
  std::uint32_t column;
  std::uint32_t length;
  const char* message;
};

void check(const Bad& bad) {
  Diagnostics diagnostics;
  const std::string line = fmt::format("node: {}", bad.text);
  const Span span{diagnostics.sources().add("t.yaml", line), 1, 7, 1};
  CAPTURE(bad.text);
  CHECK(!parse(bad.text, span, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  const Diagnostic& found = diagnostics.all()[0];
  CHECK(found.code->number == bad.code.number);
  CHECK(found.place.span.line == 1);
  CHECK(found.place.span.column == bad.column + 6);
  CHECK(found.place.span.length == bad.length);
  CHECK(found.message == bad.message);
}

}  // namespace

TEST_CASE("selector parse: scopes") {
  CHECK(choice(".").scope == Scope::self);
  CHECK(choice("..").scope == Scope::parent);
  const Choice labelled = choice("arm_l.elbow");
  CHECK(labelled.scope == Scope::group);
  CHECK(labelled.local == "arm_l");
  CHECK(labelled.label == "elbow");
  const Choice other = choice("prop:handle/control");
  CHECK(other.global == "prop");
  CHECK(other.local == "handle");
  CHECK(other.made->module == "control");
}

TEST_CASE("selector parse: indices") {
  const auto items = choice("spine[0,-1,1..3,START..-2,MIDDLE,END,*]").indices;
  REQUIRE(items.size() == 7);
  CHECK(items[0].first.number == 0);
  CHECK(items[1].first.number == -1);
  CHECK(items[2].last->number == 3);
  CHECK(items[3].first.kind == Index::Kind::start);
  CHECK(items[3].last->number == -2);
  CHECK(items[4].first.kind == Index::Kind::middle);
  CHECK(items[5].first.kind == Index::Kind::end);
  CHECK(items[6].all);
  CHECK(!items[6].last);
}

TEST_CASE("selector parse: what was made, kinds and attributes") {
  const Choice zero = choice("./control#gimbal.zero[0]");
  CHECK(zero.scope == Scope::self);
  CHECK(zero.made->module == "control");
  CHECK(zero.made->id == "gimbal");
  CHECK(zero.made->role == "zero");
  CHECK(zero.made->indices.size() == 1);
  CHECK(choice("../control").scope == Scope::parent);
  CHECK(choice("arm_l/*").made->module == "*");
  CHECK(choice("arm_l::control").kind == "control");
  CHECK(choice("arm_l.elbow/ik_fk_limb.fk").made->role == "fk");
  CHECK(choice(".@roll").attribute == "roll");
  const Choice plug = choice("./control::control@translate.x");
  CHECK(plug.attribute == "translate");
  CHECK(plug.component == "x");
  CHECK(choice("arm_l[START]/control").made->module == "control");
}

TEST_CASE("selector parse: choices and optional ones") {
  const Selector selector = good("  arm_l.toe | ./control|..?  ");
  CHECK(selector.choices.size() == 3);
  CHECK(selector.optional);
  CHECK(print(selector) == "arm_l.toe | ./control | ..?");
}

TEST_CASE("selector parse: spans of choices point into the text") {
  Diagnostics diagnostics;
  const std::string line = "with: {node: \"a.b | cc\"}";
  const auto selector =
      parse("a.b | cc", Span{diagnostics.sources().add("t", line), 1, 14, 1}, diagnostics);
  REQUIRE(selector);
  CHECK(selector->choices[0].span.column == 15);
  CHECK(selector->choices[0].span.length == 3);
  CHECK(selector->choices[1].span.column == 21);
  CHECK(selector->choices[1].span.length == 2);
}

TEST_CASE("selector parse: a text that its source spells otherwise is marked as a whole") {
  Diagnostics diagnostics;
  const Span whole{diagnostics.sources().add("t", "node: >\n  arm_l\n  [\n"), 1, 7, 1};
  CHECK(!parse("arm_l [", whole, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].place.span == whole);
}

TEST_CASE("selector parse: what is wrong and where") {
  using namespace rigc::selector::codes;
  const Bad bads[] = {
      {"", kEmpty, 1, 1, "the selector is empty"},
      {"   ", kEmpty, 1, 1, "the selector is empty"},
      {"a |", kEmpty, 4, 0, "a choice is empty"},
      {"|a", kEmpty, 1, 1, "a choice is empty"},
      {"?", kEmpty, 1, 1, "a choice is empty"},
      {"/control", kSyntax, 1, 1, "expected a local group, `.` or `..`, not `/`"},
      {"arm_l.", kSyntax, 7, 0, "expected a label, not the end"},
      {"arm l", kSyntax, 5, 1, "expected `|`, `?` or the end, not `l`"},
      {"./control x", kSyntax, 11, 1, "expected `|`, `?` or the end, not `x`"},
      {"arm_l/", kSyntax, 7, 0, "expected a module or `*`, not the end"},
      {"arm_l/control.", kSyntax, 15, 0, "expected a role, not the end"},
      {"./control#", kSyntax, 11, 0, "expected the id of a command, not the end"},
      {"./a/b", kSyntax, 4, 1, "expected `::kind`, `@attribute` or the end, not `/`"},
      {"arm_l.elbow[0]", kSyntax, 12, 1, "expected `/module`, `::kind` or `@attribute`, not `[`"},
      {"arm_l#main", kSyntax, 6, 1, "expected `/module` before `#id`, not `#`"},
      {"a::", kSyntax, 4, 0, "expected a kind of node, not the end"},
      {"a:::b", kSyntax, 4, 1, "expected a kind of node, not `:`"},
      {"a@", kSyntax, 3, 0, "expected an attribute, not the end"},
      {"a@b.", kSyntax, 5, 0, "expected x, y, z or w, not the end"},
      {"a@b@c", kSyntax, 4, 1, "expected `|`, `?` or the end, not `@`"},
      {"a[", kSyntax, 3, 0, "expected an index: a number, START, MIDDLE, END or `*`, not the end"},
      {"a[1", kSyntax, 4, 0, "expected `,` or `]`, not the end"},
      {"a[1;2]", kSyntax, 4, 1, "expected `,` or `]`, not `;`"},
      {"a[]", kSyntax, 3, 1, "expected an index: a number, START, MIDDLE, END or `*`, not `]`"},
      {"a[1...3]", kSyntax, 6, 1,
       "expected an index: a number, START, MIDDLE, END or `*`, not `.`"},
      {"...", kSyntax, 3, 1,
       "expected `/module`, `::kind`, `@attribute` or the end after `.` and `..`, not `.`"},
      {".elbow", kSyntax, 2, 5,
       "expected `/module`, `::kind`, `@attribute` or the end after `.` and `..`, not `elbow`"},
      {"a??", kSyntax, 3, 1, "expected nothing after `?`, not `?`"},
      {"a? | b", kSyntax, 4, 1, "expected nothing after `?`, not `|`"},
      {"ärm", kSyntax, 1, 1, "expected a local group, `.` or `..`, not `ä`"},
      {"a\x01", kSyntax, 2, 1,
       "expected `/module`, `::kind`, `@attribute`, `|`, `?` or the end, not `\\x01`"},
      {"3d", kBadName, 1, 2, "expected a local group, `.` or `..`, but `3d` is no name"},
      {"arm.-x", kBadName, 5, 2, "expected a label, but `-x` is no name"},
      {"a[x]", kBadIndex, 3, 1, "`x` is no index"},
      {"a[end]", kBadIndex, 3, 3, "`end` is no index"},
      {"a[1..2x]", kBadIndex, 6, 2, "`2x` is no index"},
      {"a[9999999]", kBadIndex, 3, 7, "the index 9999999 is too large"},
      {"a@translate.q", kBadComponent, 13, 1, "there is no component `q`"},
      {"prop:.", kSelfOfOtherRig, 6, 1, "`.` cannot follow the rig `prop:`"},
      {"prop:../control", kSelfOfOtherRig, 6, 2, "`..` cannot follow the rig `prop:`"},
      {"a@x | b", kMixedChoices, 7, 1, "one choice names an attribute and another does not"},
  };
  for (const Bad& bad : bads) check(bad);
}

TEST_CASE("selector parse: every wrong choice is reported") {
  Diagnostics diagnostics;
  CHECK(!parse("3d | ok | a[ | b@", Span{}, diagnostics));
  CHECK(diagnostics.errors() == 3);
}

TEST_CASE("selector parse: hints") {
  Diagnostics diagnostics;
  CHECK(!parse("a[STRAT]", Span{}, diagnostics));
  CHECK(diagnostics.all()[0].hint == "did you mean \"START\"?");
}

TEST_CASE("selector parse: random text never crashes and fails with a diagnostic") {
  static const std::string kAlphabet = "abSTARTEND.../::@@##[[]]**,,||?--?_0129 {}\t\n\x80\xff\xc3";
  RandomSelector random(7);
  int read = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (std::uint64_t i = random.below(24); i > 0; --i) {
      text += kAlphabet[random.below(kAlphabet.size())];
    }
    Diagnostics diagnostics;
    const Span span{diagnostics.sources().add("t", text), 1, 1, 1};
    const auto selector = parse(text, span, diagnostics);
    REQUIRE(selector.has_value() == diagnostics.ok());
    read += selector ? 1 : 0;
    if (!selector) CHECK(!render(diagnostics, false).empty());
    Diagnostics of_expression;
    const auto expression = parse_expression(text, span, of_expression);
    REQUIRE(expression.has_value() == of_expression.ok());
  }
  CHECK(read > 100);
}

TEST_CASE("selector parse: a slip in a good text gives an error in its line or another selector") {
  RandomSelector random(8);
  for (int round = 0; round < 5000; ++round) {
    const std::string good_text = print(random.selector(random.coin()));
    std::string text = good_text;
    text[random.below(text.size())] = static_cast<char>(random.below(256));
    Diagnostics diagnostics;
    const auto selector = parse(text, Span{}, diagnostics);
    REQUIRE(selector.has_value() == diagnostics.ok());
    if (!selector) continue;
    const auto again = parse(print(*selector), Span{}, diagnostics);
    REQUIRE(again);
    CHECK(*again == *selector);
  }
}
