// SPDX-License-Identifier: MIT
// Keys of descriptors that must or may be there. Test: tests/catalog/descriptor_test.cpp
#include "catalog/reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/codes.h"
#include "base/text.h"
#include "catalog/codes.h"

namespace rigc::catalog {

const yaml::Node* need(const yaml::Node& map, std::string_view key, std::string_view what,
                       Diagnostics& diagnostics) {
  const yaml::Node* node = map.find(key);
  if (!node) {
    diagnostics.report(codes::kMissingKey, map.span, fmt::format("{}: no `{}`", what, key));
  }
  return node;
}

std::string need_text(const yaml::Node& map, std::string_view key, std::string_view what,
                      Diagnostics& diagnostics) {
  const yaml::Node* node = need(map, key, what, diagnostics);
  if (!node) return {};
  const auto text = yaml::as_text(*node, key, diagnostics);
  if (!text) return {};
  if (trim(*text).empty()) {
    diagnostics.report(codes::kMissingKey, node->span, fmt::format("{}: `{}` is empty", what, key));
  }
  return *text;
}

std::string need_name(const yaml::Node& map, std::string_view key, std::string_view what,
                      Diagnostics& diagnostics) {
  const yaml::Node* node = need(map, key, what, diagnostics);
  if (!node) return {};
  return yaml::as_name(*node, key, diagnostics).value_or("");
}

std::string text_of(const yaml::Node& map, std::string_view key, Diagnostics& diagnostics) {
  const yaml::Node* node = map.find(key);
  return node ? yaml::as_text(*node, key, diagnostics).value_or("") : "";
}

std::string word_of(const yaml::Node& node, const std::vector<std::string>& words,
                    std::string_view what, Diagnostics& diagnostics) {
  const auto word = yaml::as_text(node, what, diagnostics);
  if (!word) return {};
  if (std::find(words.begin(), words.end(), *word) != words.end()) return *word;
  diagnostics.report(codes::kUnknownWord, node.span,
                     fmt::format("{}: unknown word \"{}\"", what, printable(*word, 60)),
                     suggest(*word, words));
  return {};
}

const std::vector<yaml::Node>& list_of(const yaml::Node& map, std::string_view key,
                                       Diagnostics& diagnostics) {
  static const std::vector<yaml::Node> kNone;
  const yaml::Node* node = map.find(key);
  if (!node) return kNone;
  if (node->is_sequence()) return node->items;
  diagnostics.report(rigc::codes::kNotASequence, node->span,
                     fmt::format("{}: expected a list", key));
  return kNone;
}

bool expect_map(const yaml::Node& node, std::string_view what, Diagnostics& diagnostics) {
  if (node.is_map()) return true;
  diagnostics.report(rigc::codes::kNotAMap, node.span, fmt::format("{}: expected a map", what));
  return false;
}

}  // namespace rigc::catalog
