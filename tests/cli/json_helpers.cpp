// SPDX-License-Identifier: MIT
// The only file of the tests that includes nlohmann's JSON: a parser that nobody here wrote.
#include "cli/json_helpers.h"

#include <nlohmann/json.hpp>

namespace rigc::test {

bool is_json(const std::string& text) { return nlohmann::json::accept(text); }

std::string json_at(const std::string& text, const std::string& pointer) {
  const auto document = nlohmann::json::parse(text, nullptr, false);
  const nlohmann::json::json_pointer at(pointer);
  return !document.is_discarded() && document.contains(at) ? document.at(at).dump() : "";
}

std::string json_keys(const std::string& text, const std::string& pointer) {
  const auto document = nlohmann::json::parse(text, nullptr, false);
  const nlohmann::json::json_pointer at(pointer);
  if (document.is_discarded() || !document.contains(at) || !document.at(at).is_object()) return "";
  std::string keys;
  for (const auto& item : document.at(at).items()) keys += item.key() + " ";
  return keys;
}

}  // namespace rigc::test
