// SPDX-License-Identifier: MIT
#include "selector/random_selector_helpers.h"

namespace rigc::selector {

std::string RandomSelector::name() {
  static const std::string kFirst = "abzAZ_";
  static const std::string kLater = "abzAZ_09-";
  static const char* kReal[] = {"arm_l", "START", "control", "x", "__", "a-1", "END", "spine"};
  if (coin()) return kReal[below(std::size(kReal))];
  std::string text(1, kFirst[below(kFirst.size())]);
  for (std::uint64_t i = below(6); i > 0; --i) text += kLater[below(kLater.size())];
  return text;
}

Index RandomSelector::index() {
  Index index;
  index.kind = static_cast<Index::Kind>(below(4));
  if (index.kind == Index::Kind::number) index.number = static_cast<int>(below(2001)) - 1000;
  return index;
}

std::vector<IndexItem> RandomSelector::indices() {
  std::vector<IndexItem> items;
  for (std::uint64_t i = 1 + below(3); i > 0; --i) {
    IndexItem& item = items.emplace_back();
    item.all = below(4) == 0;
    if (item.all) continue;
    item.first = index();
    if (coin()) item.last = index();
  }
  return items;
}

Choice RandomSelector::choice(bool plug) {
  Choice choice;
  choice.scope = static_cast<Scope>(below(3));
  if (choice.scope == Scope::group) {
    if (below(4) == 0) choice.global = name();
    choice.local = name();
    if (coin()) {
      choice.label = name();
    } else if (coin()) {
      choice.indices = indices();
    }
  }
  if (coin()) {
    Made& made = choice.made.emplace();
    made.module = below(4) == 0 ? "*" : name();
    if (coin()) made.id = name();
    if (coin()) made.role = name();
    if (coin()) made.indices = indices();
  }
  if (below(3) == 0) choice.kind = name();
  if (plug) choice.attribute = name();
  if (plug && coin()) choice.component = std::string(1, "xyzw"[below(4)]);
  return choice;
}

Selector RandomSelector::selector(bool plug) {
  Selector selector;
  for (std::uint64_t i = 1 + below(3); i > 0; --i) selector.choices.push_back(choice(plug));
  selector.optional = coin();
  return selector;
}

}  // namespace rigc::selector
