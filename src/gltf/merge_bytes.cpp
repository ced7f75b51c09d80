// SPDX-License-Identifier: MIT
// Buffer views of a file that comes to another, and its buffers that become a part of the other's:
// their bytes are never loaded. Test: tests/gltf/merge_test.cpp
#include <algorithm>
#include <map>
#include <memory>

#include "gltf/merge_parts.h"
#include "gltf/uri.h"

namespace rigc::gltf {
namespace {

using json::Value;

/// Extensions of views that say where the bytes lie in the words of the view itself.
constexpr const char* kCompressed[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// Where a buffer of the file is in the merged one: from byte `at` of `buffer` on.
struct Home {
  int buffer = -1;
  std::uint64_t at = 0;
};

/// The file's views. A view and what compresses it may lie in two buffers, whose homes become known
/// one after another.
class Views {
 public:
  Views(Patch& patch, const File& file, const Places& places)
      : patch_(patch),
        views_(file.root()["bufferViews"].items()),
        places_(places.arrays.at("bufferViews")) {
    const auto& buffers = places.arrays.at("buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i)
      if (buffers[i] >= 0) homes_[static_cast<std::int64_t>(i)] = {buffers[i], 0};
  }

  void write_all() {
    for (std::size_t i = 0; i < views_.size(); ++i) write(i);
  }

  /// Writes what lies in a buffer of the file again.
  void place(std::int64_t buffer, const Home& home) {
    homes_[buffer] = home;
    const auto lies_there = [&](const Value& view) { return view["buffer"].integer() == buffer; };
    for (std::size_t i = 0; i < views_.size(); ++i)
      if (lies_there(views_[i]) ||
          std::any_of(std::begin(kCompressed), std::end(kCompressed),
                      [&](const char* name) { return lies_there(views_[i]["extensions"][name]); }))
        write(i);
  }

 private:
  void write(std::size_t index) {
    const Value& view = views_[index];
    Edits edits;
    move(view, edits);
    for (const char* name : kCompressed) move(view["extensions"][name], edits);
    edits.sort();
    patch_.replace("bufferViews", places_[index], edits.text(view));
  }

  /// Edits the buffer and the first byte of a view or of what compresses it.
  void move(const Value& view, Edits& edits) const {
    const auto buffer = view["buffer"].integer();
    const auto home = buffer ? homes_.find(*buffer) : homes_.end();
    if (home == homes_.end()) return;
    edits.replace(view["buffer"], std::to_string(home->second.buffer));
    if (home->second.at == 0) return;
    const Value offset = view["byteOffset"];
    const auto first = static_cast<std::uint64_t>(offset.integer().value_or(0));
    const std::string text = std::to_string(first + home->second.at);
    if (offset)
      edits.replace(offset, text);
    else
      edits.insert(view, "byteOffset", text);
  }

  Patch& patch_;
  std::vector<Value> views_;
  std::vector<int> places_;
  std::map<std::int64_t, Home> homes_;  ///< by buffer of the file
};

}  // namespace

bool is_taken_in(const File& file, std::size_t index, const MergeOptions& options) {
  const Buffer& buffer = file.buffers[index];
  if (buffer.bytes.empty()) return false;
  if (buffer.uri.empty()) return true;
  return options.binary && (is_data_uri(buffer.uri) || (index == 0 && !file.binary));
}

void write_views(Patch& patch, const File& file, const Places& places,
                 const MergeOptions& options) {
  const auto views = std::make_shared<Views>(patch, file, places);
  views->write_all();
  for (std::size_t i = 0; i < file.buffers.size(); ++i) {
    if (!is_taken_in(file, i, options)) continue;
    const auto number = static_cast<std::int64_t>(i);
    patch.append_bytes(file.buffers[i].bytes, [views, number](int buffer, std::uint64_t at) {
      views->place(number, {buffer, at});
    });
  }
}

}  // namespace rigc::gltf
