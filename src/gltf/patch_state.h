// SPDX-License-Identifier: MIT
// What a Patch has gathered: changed, appended and released elements by top-level array, changed
// root members, bytes for the buffer, and what the file was before its first rig. Inside of
// patch*.cpp. Test: tests/gltf/patch_test.cpp
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gltf/patch.h"

namespace rigc::gltf {

/// Bytes of a buffer, from begin to before end.
struct Interval {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// Changes to one top-level array.
struct ArrayChanges {
  std::vector<json::Value> original;
  std::size_t kept = 0;                        ///< of the original elements: the others are cut
  std::map<std::size_t, std::string> changed;  ///< original index to new text
  std::vector<std::string> appended;
  bool has_slots = false;      ///< `free` knows the placeholders that the file has
  std::set<std::size_t> free;  ///< nothing uses them; append gives them out first
  std::vector<int> given;      ///< what append gave out

  std::size_t size() const { return kept + appended.size(); }
  bool touched() const { return kept != original.size() || !changed.empty() || !appended.empty(); }
  /// Valid until the element changes.
  std::string_view text(std::size_t index) const;
  void set(std::size_t index, std::string json);
  void truncate(std::size_t size);
  /// Cuts the elements at the end that are free.
  void cut_tail();
  /// Whether an original element is still there as others know it.
  bool keeps(std::size_t index) const { return index < kept && free.count(index) == 0; }
};

/// A buffer view of ours, written when the place of its bytes is known; or bytes whose views
/// somebody else writes.
struct PendingView {
  int index = 0;             ///< in bufferViews; -1: `placed` writes the views
  std::uint64_t offset = 0;  ///< in State::data
  std::uint64_t length = 0;
  int target = 0;
  Bytes bytes = {};  ///< instead of State::data
  std::function<void(int buffer, std::uint64_t at)> placed = {};
  std::uint64_t alignment() const { return placed ? 8 : 4; }
};

/// What cannot be told from a file with a rig: kept in RIGC_rig as `before`, so that taking the rig
/// out gives the very bytes back.
struct Before {
  std::string byte_length;           ///< of buffer 0 as it is spelled; empty without buffers
  std::uint64_t length = 0;          ///< its value
  std::optional<std::uint64_t> bin;  ///< bytes of the BIN chunk, if there is one
  bool scenes = true;                ///< the file has scenes
  std::set<std::string> empty;       ///< pointers to containers that are there without members

  std::string text() const;
};

struct Patch::State {
  explicit State(const File& the_file);

  ArrayChanges& array(std::string_view name);
  const ArrayChanges* find(std::string_view name) const;
  /// The array with its free elements known.
  ArrayChanges& slots(std::string_view name);
  /// The bytes of a buffer view that goes are free.
  void release_bytes(std::size_t view);
  /// Text of a root member as it is now; empty where there is none.
  std::string member(std::string_view name) const;
  void set_member(std::string_view name, std::string json);
  /// `now` is the text of a container of the file that gets a member: remembers that it had none.
  void fills(const std::string& pointer, std::string_view now);
  /// `text`, or nothing where it is a container without members that was not there before.
  std::string emptied(const std::string& pointer, std::string text) const;
  /// A placeholder for an element of this array, which may bring an accessor of zeros.
  std::string new_placeholder(std::string_view array);

  const File& file;
  std::deque<std::pair<std::string, ArrayChanges>>
      arrays;  ///< in the order first touched; never move
  std::vector<std::pair<std::string, std::string>> members;  ///< of the root; empty text: removed
  std::string data;
  std::vector<PendingView> views;
  std::map<std::size_t, std::vector<Interval>> free_bytes;  ///< of released views, by buffer
  Before before;
};

/// A minimal valid element marked as free; some kinds need accessors.
std::string placeholder(std::string_view array, int first = 0, int second = 0);
bool is_placeholder(std::string_view array, std::string_view text);
/// A placeholder that remembers which bytes are free.
std::string free_view(std::size_t buffer, const Interval& bytes);
/// Puts placeholders into all free places but those at the end of an array, which are cut.
void settle(Patch::State& state);

std::uint64_t unsigned_member(const json::Value& object, std::string_view key);

/// Bytes of ours in a buffer.
struct Placed {
  std::size_t view = 0;  ///< in State::views
  std::uint64_t at = 0;  ///< in the buffer
  std::uint64_t length = 0;
};

/// The buffer that takes our bytes, and what else is in it.
struct BytePlan {
  enum class Home { none, bin, file };
  Home home = Home::none;
  int buffer = -1;                     ///< its index; -1: a new one
  Bytes prefix;                        ///< what it keeps, from its first byte on
  std::vector<Placed> placed;          ///< by place: into holes of the prefix, or behind it
  std::vector<Interval> free;          ///< holes that remain
  std::uint64_t length = 0;            ///< of all that is kept and placed
  std::string byte_length;             ///< as text; empty: the buffer goes, or none comes
  std::optional<std::uint64_t> chunk;  ///< bytes of BIN, where the output has that chunk
  bool changed = false;                ///< the buffer's bytes are not the prefix alone
};

/// Finds the buffer and the places of our bytes.
BytePlan plan_bytes(Patch::State& state, bool binary);
/// The first `length` bytes of the plan's buffer, zeros where nothing else is.
std::vector<Bytes> pieces_of(const Patch::State& state, const BytePlan& plan, std::uint64_t length);
/// Bytes that remain free, with their buffers. Buffers of ours that nothing uses any more are
/// released.
std::vector<std::pair<std::size_t, Interval>> remaining_bytes(Patch::State& state,
                                                              const BytePlan& plan);

/// The root object's text with all changes.
std::string patched_json(const Patch::State& state);

}  // namespace rigc::gltf
