// SPDX-License-Identifier: MIT
// Tests of src/selector/print.cpp: canonical texts and renaming.
#include <doctest/doctest.h>

#include "selector/codes.h"
#include "selector/random_selector_helpers.h"
#include "selector/selector.h"

using namespace rigc;
using namespace rigc::selector;

namespace {

std::string renamed(const std::string& text,
                    const std::vector<std::pair<std::string, std::string>>& groups) {
  Diagnostics diagnostics;
  auto selector = parse(text, Span{}, diagnostics);
  REQUIRE(selector);
  rename_groups(*selector, groups);
  return print(*selector);
}

}  // namespace

TEST_CASE("selector print: parse gives the printed selector back") {
  RandomSelector random(1);
  for (int round = 0; round < 5000; ++round) {
    const Selector selector = random.selector(random.coin());
    const std::string text = print(selector);
    CAPTURE(text);
    Diagnostics diagnostics;
    const auto again = parse(text, Span{}, diagnostics);
    REQUIRE(again);
    CHECK(*again == selector);
    CHECK(print(*again) == text);
  }
}

TEST_CASE("selector print: spaces are canonical") {
  Diagnostics diagnostics;
  CHECK(print(*parse(" a[ 1 , -2 ]|b ?", Span{}, diagnostics)) == "a[1,-2] | b?");
  CHECK(print(*parse("a[007]", Span{}, diagnostics)) == "a[7]");
}

TEST_CASE("selector print: groups are renamed in every choice, once") {
  const std::vector<std::pair<std::string, std::string>> groups = {{"arm", "arm_l"},
                                                                   {"arm_l", "wrong"}};
  CHECK(renamed("arm.elbow/control | arm[0] | hand", groups) ==
        "arm_l.elbow/control | arm_l[0] | hand");
  CHECK(renamed("./arm", groups) == "./arm");
  CHECK(renamed("hand.arm", groups) == "hand.arm");
}

TEST_CASE("selector print: groups of another rig keep their names") {
  CHECK(renamed("prop:arm", {{"arm", "arm_l"}}) == "prop:arm");
}

TEST_CASE("selector print: spans take no part in equality") {
  Diagnostics diagnostics;
  const auto a = parse("a.b", Span{1, 2, 3, 4}, diagnostics);
  const auto b = parse("a.b", Span{5, 6, 7, 8}, diagnostics);
  CHECK(*a == *b);
  CHECK(!(*a == *parse("a.c", Span{}, diagnostics)));
}
