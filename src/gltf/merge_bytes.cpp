// SPDX-License-Identifier: MIT
// Buffer views of a file that comes to another, and the buffer that becomes a part of the other's:
// its bytes are never loaded. Test: tests/gltf/merge_test.cpp
#include "gltf/merge_parts.h"

namespace rigc::gltf {
namespace {

using json::Value;

/// Extensions of views that say where the bytes lie in the words of the view itself.
constexpr const char* kCompressed[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// Where a file's buffers are in the merged one.
struct Buffers {
  const Places& places;
  int taken_in = -1;  ///< buffer of the file that became a part of buffer `home`
  int home = -1;
  std::uint64_t at = 0;  ///< first byte of that part
};

/// Edits the buffer and the first byte of a view or of what compresses it.
void move(const Value& view, const Buffers& buffers, Edits& edits) {
  const auto buffer = view["buffer"].integer();
  if (!buffer) return;
  const bool taken_in = *buffer == buffers.taken_in;
  const int now = taken_in ? buffers.home : buffers.places.find("buffers", *buffer);
  if (now < 0) return;
  edits.replace(view["buffer"], std::to_string(now));
  if (!taken_in || buffers.at == 0) return;
  const Value offset = view["byteOffset"];
  const auto first = static_cast<std::uint64_t>(offset.integer().value_or(0));
  const std::string text = std::to_string(first + buffers.at);
  if (offset)
    edits.replace(offset, text);
  else
    edits.insert(view, "byteOffset", text);
}

void write(Patch& patch, const File& file, const Buffers& buffers, bool taken_in) {
  const auto views = file.root()["bufferViews"].items();
  Edits edits;
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < views.size(); ++i) {
    bool concerned = views[i]["buffer"].integer() == buffers.taken_in;
    for (const char* name : kCompressed)
      if (views[i]["extensions"][name]["buffer"].integer() == buffers.taken_in) concerned = true;
    if (concerned != taken_in) continue;
    moved.push_back(i);
    move(views[i], buffers, edits);
    for (const char* name : kCompressed) move(views[i]["extensions"][name], buffers, edits);
  }
  edits.sort();
  for (const std::size_t i : moved)
    patch.replace("bufferViews",
                  buffers.places.find("bufferViews", static_cast<std::int64_t>(i)),
                  edits.text(views[i]));
}

}  // namespace

bool is_taken_in(const File& file, std::size_t index, const MergeOptions& options) {
  if (index != 0 || file.buffers[0].bytes.empty()) return false;
  const bool in_bin = file.buffers[0].uri.empty() && !file.root()["buffers"].items()[0]["uri"];
  return in_bin || (options.binary && !file.binary);
}

void write_views(Patch& patch, const File& file, const Places& places,
                 const MergeOptions& options) {
  const bool takes = !file.buffers.empty() && is_taken_in(file, 0, options);
  write(patch, file, {places, takes ? 0 : -1}, false);
  if (!takes) return;
  patch.append_bytes(file.buffers[0].bytes, [&patch, &file, places](int buffer, std::uint64_t at) {
    write(patch, file, {places, 0, buffer, at}, true);
  });
}

}  // namespace rigc::gltf
