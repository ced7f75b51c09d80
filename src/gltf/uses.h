// SPDX-License-Identifier: MIT
// Who uses accessors and buffer views of a file: what nobody uses any more is released.
// Test: tests/lossless/bake_test.cpp
#pragma once

#include <set>
#include <vector>

#include "gltf/patch.h"

namespace rigc::gltf {

/// Accessors that a mesh names.
std::vector<int> accessors_of(const json::Value& mesh);

class Uses {
 public:
  /// Counts mentions by meshes, skins, animations, sparse accessors and images.
  explicit Uses(const File& file);

  /// One mention less: where it was the last, releases the accessor, and then its buffer views.
  /// What is not `ours` stays where an integer in an extension may be a mention.
  void drop_accessor(Patch& patch, int accessor, bool ours);

 private:
  void drop_view(Patch& patch, const json::Value& index, bool ours);
  bool may_go(std::size_t index, bool ours);
  void find_mentions(const json::Value& value, bool inside);

  const File& file_;
  std::vector<json::Value> accessors_;
  std::vector<int> accessor_uses_, view_uses_;
  bool has_mentions_ = false;
  std::set<std::int64_t> mentions_;  ///< integers in extensions, found when they matter
};

}  // namespace rigc::gltf
