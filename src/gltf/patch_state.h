// SPDX-License-Identifier: MIT
// What a Patch has gathered: changed, appended and cut elements by top-level array, changed root
// members, bytes for the buffer. Inside of patch.cpp and patch_finish.cpp. Test:
// tests/gltf/patch_test.cpp
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gltf/patch.h"

namespace rigc::gltf {

/// Changes to one top-level array.
struct ArrayChanges {
  std::vector<json::Value> original;
  std::size_t kept = 0;                        ///< of the original elements: the others are cut
  std::map<std::size_t, std::string> changed;  ///< original index to new text
  std::vector<std::string> appended;

  std::size_t size() const { return kept + appended.size(); }
  bool touched() const { return kept != original.size() || !changed.empty() || !appended.empty(); }
  std::string text(std::size_t index) const;
  void set(std::size_t index, std::string json);
};

/// A buffer view of ours, written when the place of its bytes is known.
struct PendingView {
  int index = 0;             ///< in bufferViews
  std::uint64_t offset = 0;  ///< in State::data
  std::uint64_t length = 0;
  int target = 0;
};

struct Patch::State {
  explicit State(const File& the_file) : file(the_file) {}

  ArrayChanges& array(std::string_view name);
  const ArrayChanges* find(std::string_view name) const;
  /// Text of a root member as it is now; empty where there is none.
  std::string member(std::string_view name) const;
  void set_member(std::string_view name, std::string json);
  std::string_view original_extras(int node) const;
  /// An accessor of zeros for placeholders: "position", "input" or "output".
  int zeros(std::string_view purpose);

  const File& file;
  std::deque<std::pair<std::string, ArrayChanges>>
      arrays;  ///< in the order first touched; never move
  std::vector<std::pair<std::string, std::string>> members;  ///< of the root; empty text: removed
  std::string data;
  std::vector<PendingView> views;
  std::optional<std::uint64_t> buffer_length;
  std::vector<std::pair<std::string, int>> zero_accessors;  ///< of placeholders, by purpose
};

/// The root object's text with all changes.
std::string patched_json(const Patch::State& state);

}  // namespace rigc::gltf
