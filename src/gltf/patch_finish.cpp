// SPDX-License-Identifier: MIT
// Writes a Patch: the JSON text with its changes, and the buffer that holds our bytes, as .glb or
// .gltf. Test: tests/gltf/patch_test.cpp
#include <algorithm>
#include <set>

#include "base/ids.h"
#include "base/text.h"
#include "gltf/codes.h"
#include "gltf/patch.h"
#include "gltf/patch_state.h"
#include "gltf/splice.h"
#include "gltf/uri.h"

namespace rigc::gltf {
namespace {

using State = Patch::State;
using Home = BytePlan::Home;

std::size_t padding(std::size_t size) { return (4 - size % 4) % 4; }

/// Changes or adds the rig's buffer and gives its index.
int write_buffer(State& state, const BytePlan& plan, const std::string& uri) {
  if (plan.byte_length.empty()) return -1;
  if (plan.buffer >= 0) {
    ArrayChanges& buffers = state.array("buffers");
    const auto index = static_cast<std::size_t>(plan.buffer);
    std::string text(buffers.text(index));
    if (buffers.original[index]["uri"] || !uri.empty())
      text = with_member(text, "uri", uri.empty() ? "" : json::quote(uri));
    if (buffers.original[index]["byteLength"].text() != plan.byte_length)
      text = with_member(text, "byteLength", plan.byte_length);
    buffers.set(index, std::move(text));
    return plan.buffer;
  }
  json::Writer writer;
  writer.begin_object().key("byteLength").raw(plan.byte_length);
  if (!uri.empty()) writer.member("uri", uri);
  ArrayChanges& buffers = state.slots("buffers");
  std::size_t index = buffers.size();
  if (index > 0 && buffers.text(0).empty()) {
    index = 0;  // kept for it
    buffers.set(index, writer.end_object().take());
  } else if (!buffers.free.empty()) {
    index = *buffers.free.begin();
    buffers.free.erase(buffers.free.begin());
    buffers.set(index, writer.end_object().take());
  } else {
    buffers.appended.push_back(writer.end_object().take());
  }
  return static_cast<int>(index);
}

void write_views(State& state, const BytePlan& plan, int buffer) {
  for (const Placed& placed : plan.placed) {
    const PendingView& view = state.views[placed.view];
    if (view.placed) {
      view.placed(buffer, placed.at);
      continue;
    }
    json::Writer writer;
    writer.begin_object().member("buffer", buffer).key("byteOffset");
    writer.integer(static_cast<std::int64_t>(placed.at)).key("byteLength");
    writer.integer(static_cast<std::int64_t>(placed.length));
    if (view.target != 0) writer.member("target", view.target);
    state.array("bufferViews")
        .set(static_cast<std::size_t>(view.index), writer.end_object().take());
  }
}

/// Views without a use remember which bytes are free.
void write_free_views(State& state, const BytePlan& plan) {
  if (state.free_bytes.empty()) return;
  ArrayChanges& views = state.slots("bufferViews");
  for (const auto& [buffer, bytes] : remaining_bytes(state, plan)) {
    std::string text = free_view(buffer, bytes);
    if (views.free.empty()) {
      views.appended.push_back(std::move(text));
    } else {
      views.set(*views.free.begin(), std::move(text));
      views.free.erase(views.free.begin());
    }
  }
}

/// Files beside the input that buffers and images name, but for the buffer that became part of the
/// output.
std::vector<std::string> referenced_files(State& state, const BytePlan& plan) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const char* array : {"buffers", "images"}) {
    const ArrayChanges& changes = state.array(array);
    for (std::size_t i = 0; i < changes.original.size(); ++i) {
      const bool buffer = std::string_view(array) == "buffers";
      if (!changes.keeps(i) || (buffer && static_cast<int>(i) == plan.buffer)) continue;
      const auto uri = changes.original[i]["uri"].string();
      if (!uri || is_data_uri(*uri) || is_absolute_uri(*uri)) continue;
      const auto name = percent_decoded(*uri);
      if (name && known.insert(*name).second) names.push_back(*name);
    }
  }
  return names;
}

void append_uint32(std::string& out, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

/// Header and JSON chunk, BIN in pieces, the chunks that followed it.
void lay_out_glb(Output& output, const State& state, const BytePlan& plan, std::string json) {
  const File& file = state.file;
  json.append(padding(json.size()), ' ');
  std::optional<std::uint64_t> bin = plan.chunk;
  if (plan.home != Home::bin) bin = file.bin ? std::optional(file.bin->size()) : std::nullopt;
  std::uint64_t total = 12 + 8 + json.size() + (bin ? 8 + *bin : 0);
  for (const Bytes& chunk : file.other_chunks) total += chunk.size();

  std::string head = "glTF";
  append_uint32(head, 2);
  append_uint32(head, total);
  append_uint32(head, json.size());
  head += "JSON";
  std::vector<Bytes>& pieces = output.pieces;
  pieces = {std::move(head), std::move(json)};
  if (bin) {
    std::string bin_head;
    append_uint32(bin_head, *bin);
    bin_head += std::string_view("BIN\0", 4);
    pieces.push_back(std::move(bin_head));
    const std::vector<Bytes> bytes =
        plan.home == Home::bin ? pieces_of(state, plan, *bin) : std::vector<Bytes>{*file.bin};
    pieces.insert(pieces.end(), bytes.begin(), bytes.end());
  }
  pieces.insert(pieces.end(), file.other_chunks.begin(), file.other_chunks.end());
}

/// The rig's buffer in one string, for a file of its own.
std::optional<std::string> rig_buffer(const State& state, const BytePlan& plan,
                                      Diagnostics& diagnostics) {
  std::string bytes;
  for (const Bytes& piece : pieces_of(state, plan, plan.length)) {
    const auto text = piece.text(diagnostics);
    if (!text) return std::nullopt;
    bytes += *text;
  }
  return bytes;
}

/// With what stood before and behind the root object. Blanks behind it that were more than the
/// padding of a chunk stay more.
std::string whole_json(const State& state, bool binary) {
  const std::string_view text = state.file.json.text();
  const json::Value root = state.file.root();
  std::string out(text.substr(0, root.begin()));
  out += patched_json(state);
  std::string_view rest = text.substr(root.end());
  if (!state.file.binary) return out.append(rest);
  while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
  out += rest;
  if (!binary) return out;
  const auto used = static_cast<std::size_t>(rest.data() + rest.size() - text.data());
  const std::size_t blanks = text.size() - used, least = padding(used);
  out.append(padding(out.size()) + (blanks > least ? blanks - least : 0), ' ');
  return out;
}

Output copy_of(const File& file) {
  Output output;
  output.pieces = {file.whole};
  output.unchanged = true;
  return output;
}

}  // namespace

std::uint64_t Output::size() const {
  std::uint64_t total = 0;
  for (const Bytes& piece : pieces) total += piece.size();
  return total;
}

std::string patched_json(const State& state) {
  Splice root(state.file.root());
  for (const auto& [name, changes] : state.arrays) {
    if (!changes.touched()) continue;
    if (root.find(name) < 0) {
      if (changes.size() != 0) root.set(name, "[" + join(changes.appended, ",") + "]");
      continue;
    }
    Splice array(state.file.root()[name]);
    for (const auto& [index, text] : changes.changed) array.replace(index, text);
    array.truncate(changes.kept);
    for (const std::string& text : changes.appended) array.append(text);
    root.set(name, state.emptied("/" + name, array.text()));
  }
  for (const auto& [name, text] : state.members) root.set(name, text);
  return root.text();
}

std::optional<Output> Patch::finish(bool binary, Diagnostics& diagnostics) {
  State& state = *state_;
  const BytePlan plan = plan_bytes(state, binary);
  Output output;
  std::string uri;
  if (plan.home == Home::file && !plan.byte_length.empty()) {
    auto bytes = rig_buffer(state, plan, diagnostics);
    if (!bytes) return std::nullopt;
    uri = "rigc_" + hex16(hash64(*bytes)) + ".bin";
    output.extra_files.push_back({uri, *std::move(bytes)});
  }
  if (plan.home != Home::none) write_views(state, plan, write_buffer(state, plan, uri));
  write_free_views(state, plan);
  settle(state);

  std::string json = whole_json(state, binary);
  if (binary == file_.binary && json == file_.json.text() && !plan.changed)
    output = copy_of(file_);
  else if (binary)
    lay_out_glb(output, state, plan, std::move(json));
  else {
    output.pieces.push_back(std::move(json));
    if (!file_.other_chunks.empty())
      diagnostics.report(codes::kChunksLost, Place(file_.path),
                         "a .gltf has no place for the extra chunks of this .glb");
  }
  output.copies = referenced_files(state, plan);
  if (binary && output.size() > UINT32_MAX) {
    diagnostics.report(codes::kGlbTooLarge, Place(file_.path),
                       "the output would have more than 4 GiB, which a .glb cannot hold",
                       "write a .gltf instead");
    return std::nullopt;
  }
  return output;
}

}  // namespace rigc::gltf
