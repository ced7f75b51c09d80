// SPDX-License-Identifier: MIT
// Tables of keys. Test: tests/base/format_test.cpp
#include "base/format.h"

#include <algorithm>
#include <cassert>

namespace rigc::yaml {

const Key* Section::find(std::string_view key) const {
  for (const Key& candidate : keys)
    if (candidate.name == key) return &candidate;
  return nullptr;
}

const std::vector<std::string>& Section::words(std::string_view key) const {
  const Key* found = find(key);
  assert(found);
  return found->rule.words;
}

bool check_section(const Node& node, const Section& section, std::string_view what,
                   Diagnostics& diagnostics) {
  const auto is_known = [&](const Node::Entry& entry) { return section.find(entry.key); };
  if (node.is_map() && std::all_of(node.entries.begin(), node.entries.end(), is_known)) return true;
  std::vector<std::string> known;
  for (const Key& key : section.keys) known.push_back(key.name);
  return check_keys(node, known, what, diagnostics);
}

bool check_section(const Node& node, const Section& section, Diagnostics& diagnostics) {
  return check_section(node, section, section.what, diagnostics);
}

}  // namespace rigc::yaml
