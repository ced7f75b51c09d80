// SPDX-License-Identifier: MIT
// Random selectors for property tests: anything that the grammar allows.
#pragma once

#include <random>
#include <string>

#include "selector/selector.h"

namespace rigc::selector {

class RandomSelector {
 public:
  explicit RandomSelector(std::uint64_t seed) : random_(seed) {}
  Selector selector(bool plug);
  std::uint64_t below(std::uint64_t count) { return random_() % count; }
  bool coin() { return below(2) == 0; }

 private:
  std::string name();
  Index index();
  std::vector<IndexItem> indices();
  Choice choice(bool plug);
  std::mt19937_64 random_;
};

}  // namespace rigc::selector
