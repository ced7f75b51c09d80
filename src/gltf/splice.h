// SPDX-License-Identifier: MIT
// A JSON object or array as the texts of its members: some are changed, the others are copied
// through with their spelling and white space. Test: tests/gltf/patch_test.cpp
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"

namespace rigc::gltf {

class Splice {
 public:
  /// Views into the text of `container`'s document, which must outlive this.
  explicit Splice(const json::Value& container);

  std::size_t size() const { return parts_.size(); }
  std::string_view value(std::size_t index) const { return parts_[index].value; }
  /// Index of a member of an object, or -1.
  int find(std::string_view key) const;

  void replace(std::size_t index, std::string json);
  void erase(std::size_t index);
  /// Cuts to the first `size` members.
  void truncate(std::size_t size);
  /// Appends to an array, with the white space that stands before the element above.
  void append(std::string json);
  /// Replaces a member of an object, appends it, or removes it where `json` is empty.
  void set(std::string_view key, std::string json);

  std::string text() const;

 private:
  struct Part {
    std::string_view lead;  ///< white space before the member
    std::string_view head;  ///< key and colon with the white space between; empty in arrays
    std::string_view value;
    std::string_view trail;  ///< white space before the comma
  };
  void push(std::string_view head, std::string json);
  std::string_view keep(std::string text);

  char open_, close_;
  std::vector<Part> parts_;
  std::vector<std::string> keys_;  ///< of an object, by part
  std::string_view tail_;          ///< white space before the closing bracket
  std::deque<std::string> kept_;   ///< texts that parts view; a deque never moves them
};

/// The document of a text that was read before or that rigc wrote; without a text that of an empty
/// object. Only where that is too large now there is no root.
json::Document parsed(std::string text);
/// `text` (one JSON object) with a member set, or removed where `json` is empty.
std::string with_member(const std::string& text, std::string_view key, std::string json);
/// Whether a text is an object or array without members.
bool is_empty_container(std::string_view text);

}  // namespace rigc::gltf
