// SPDX-License-Identifier: MIT
// Replaced values of a JSON text: everything else is copied through with its spelling.
// Test: tests/gltf/merge_test.cpp
#pragma once

#include <string>
#include <vector>

#include "base/json.h"

namespace rigc::gltf {

/// Values of one document and what stands in their places.
class Edits {
 public:
  /// The first replacement of a value counts.
  void replace(const json::Value& value, std::string json);
  /// Puts a member in front of an object's others; the object is not empty.
  void insert(const json::Value& object, std::string_view key, std::string_view json);
  /// To be called between the last replacement and the first text.
  void sort();
  bool empty() const { return edits_.empty(); }

  /// Text of a value with what was replaced inside of it.
  std::string text(const json::Value& value) const;

 private:
  struct Edit {
    std::size_t begin, end;  ///< in the document
    std::string text;
  };
  std::vector<Edit> edits_;
};

}  // namespace rigc::gltf
