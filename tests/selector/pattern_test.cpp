// SPDX-License-Identifier: MIT
// The regular expression of selectors takes what the parser takes, on random good and spoilt texts.
#include "selector/pattern.h"

#include <doctest/doctest.h>

#include <regex>

#include "selector/random_selector_helpers.h"
#include "selector/selector.h"

using namespace rigc;
using namespace rigc::selector;

namespace {

/// Whether a text is a selector of nodes only, or of plugs only.
bool parses(const std::string& text, Wanted wanted) {
  Diagnostics diagnostics;
  const auto selector = parse(text, Span{}, diagnostics);
  if (!selector) return false;
  for (const Choice& choice : selector->choices)
    if (choice.attribute.empty() == (wanted == Wanted::plug)) return false;
  return true;
}

}  // namespace

TEST_CASE("selector pattern: takes what the parser takes") {
  const std::regex node(pattern(Wanted::node));
  const std::regex plug(pattern(Wanted::plug));
  static const std::string kAlphabet = "abST.../::@@##[[]]**,,||?--?_0129 \t\n";
  RandomSelector random(21);
  int good = 0, bad = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = print(random.selector(random.coin()));
    if (round % 4 != 0) text[random.below(text.size())] = kAlphabet[random.below(kAlphabet.size())];
    if (round % 8 == 5) text.insert(random.below(text.size()), " ");
    for (const Wanted wanted : {Wanted::node, Wanted::plug}) {
      const bool is_good = parses(text, wanted);
      INFO(text);
      CHECK(std::regex_match(text, wanted == Wanted::node ? node : plug) == is_good);
      (is_good ? good : bad) += 1;
    }
  }
  CHECK(good > 1000);
  CHECK(bad > 1000);
}
