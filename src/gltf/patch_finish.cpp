// SPDX-License-Identifier: MIT
// Writes a Patch: the JSON text with its changes, and the buffer that holds our bytes, as .glb or
// .gltf. Test: tests/gltf/patch_test.cpp
#include <algorithm>
#include <cassert>

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

/// Where the rig's bytes go, and with them what the input had there.
struct Plan {
  enum class Home { none, bin, file };
  Home home = Home::none;
  bool first = false;  ///< the rig's buffer is buffer 0, which begins with `prefix`
  std::string_view prefix;
  std::uint64_t base = 0;    ///< offset of our data in the rig's buffer
  std::uint64_t length = 0;  ///< of the rig's buffer
  bool verbatim = false;     ///< BIN is copied with its padding
};

std::uint64_t aligned(std::uint64_t size) { return (size + 3) / 4 * 4; }

std::uint64_t unsigned_member(const json::Value& object, std::string_view key) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(object[key].integer().value_or(0), 0));
}

/// What the views of a file say about one buffer once those at the end are cut.
struct Use {
  bool kept = false;                       ///< a view that stays uses it
  std::uint64_t kept_end = 0;              ///< end of those
  std::optional<std::uint64_t> cut_begin;  ///< first byte of those that go
};

/// `view` is a buffer view, or an extension of one that names a buffer in the same words (meshopt).
void add_use(std::vector<Use>& uses, const json::Value& view, bool kept) {
  const auto buffer = view["buffer"].integer();
  if (!buffer || *buffer < 0 || *buffer >= static_cast<std::int64_t>(uses.size())) return;
  Use& use = uses[static_cast<std::size_t>(*buffer)];
  const std::uint64_t begin = unsigned_member(view, "byteOffset");
  if (kept) {
    use.kept = true;
    use.kept_end = std::max(use.kept_end, begin + unsigned_member(view, "byteLength"));
  } else {
    use.cut_begin = std::min(use.cut_begin.value_or(begin), begin);
  }
}

/// Cuts what only cut views used: buffers at the end of the list, and the end of a .glb's buffer 0.
void cut_buffers(State& state) {
  const ArrayChanges* views = state.find("bufferViews");
  if (!views || views->kept == views->original.size()) return;
  ArrayChanges& buffers = state.array("buffers");
  std::vector<Use> uses(buffers.original.size());
  for (std::size_t i = 0; i < views->original.size(); ++i) {
    const bool kept = i < views->kept;
    add_use(uses, views->original[i], kept);
    for (const auto& [name, extension] : views->original[i]["extensions"].members())
      add_use(uses, extension, kept);
  }
  const bool bin = state.file.bin.data() && !uses.empty() && !buffers.original[0]["uri"];
  if (bin && !state.buffer_length && uses[0].cut_begin && uses[0].kept_end <= *uses[0].cut_begin)
    state.buffer_length = *uses[0].cut_begin;
  while (buffers.kept > 0 && buffers.appended.empty()) {
    const Use& last = uses[buffers.kept - 1];
    const bool whole = last.cut_begin == std::uint64_t{0} && !last.kept;
    const bool exact = buffers.kept == 1 && bin && state.buffer_length.value_or(0) > 0;
    if (!whole || exact) break;
    --buffers.kept;
  }
}

/// Buffer 0 as it will be without our data.
std::string_view first_bytes(const State& state, std::size_t buffer_count) {
  const File& file = state.file;
  if (file.buffers.empty()) return file.bin;
  if (buffer_count == 0) return {};
  const std::string_view bytes = file.buffers[0].bytes;
  return bytes.substr(0, state.buffer_length.value_or(bytes.size()));
}

Plan make_plan(State& state, bool binary) {
  const File& file = state.file;
  const ArrayChanges& buffers = state.array("buffers");
  const bool has_first = buffers.size() > 0;
  const bool in_bin = file.bin.data() && (buffers.original.empty() || !buffers.original[0]["uri"]);
  const bool filled = has_first && !file.buffers.empty() && !file.buffers[0].bytes.empty();
  Plan plan;
  if (binary && (file.binary ? in_bin : filled)) {
    plan.home = Plan::Home::bin;
  } else if (!binary && in_bin && has_first) {
    plan.home = Plan::Home::file;
  }
  plan.first = plan.home != Plan::Home::none;
  if (!plan.first && !state.data.empty()) {
    plan.first = binary && !has_first;
    plan.home = plan.first ? Plan::Home::bin : Plan::Home::file;
  } else if (plan.first) {
    plan.prefix = first_bytes(state, buffers.size());
    plan.verbatim =
        file.binary && binary && state.data.empty() && buffers.kept == buffers.original.size() &&
        (buffers.original.empty() || plan.prefix.size() == file.buffers[0].bytes.size());
  }
  plan.base = aligned(plan.prefix.size());
  plan.length = state.data.empty() ? plan.prefix.size() : plan.base + state.data.size();
  return plan;
}

std::string zeros(std::uint64_t length) { return std::string(aligned(length) - length, '\0'); }

/// Changes or appends the rig's buffer and gives its index.
int write_buffer(State& state, const Plan& plan, const std::string& uri) {
  ArrayChanges& buffers = state.array("buffers");
  if (plan.first && buffers.size() > 0) {
    std::string text = buffers.text(0);
    if (buffers.original[0]["uri"] || !uri.empty())
      text = with_member(text, "uri", uri.empty() ? "" : json::quote(uri));
    if (unsigned_member(buffers.original[0], "byteLength") != plan.length)
      text = with_member(text, "byteLength", std::to_string(plan.length));
    buffers.set(0, std::move(text));
    return 0;
  }
  if (plan.length == 0 || (state.data.empty() && plan.verbatim)) return -1;
  json::Writer writer;
  writer.begin_object().member("byteLength", plan.length);
  if (!uri.empty()) writer.member("uri", uri);
  writer.end_object();
  buffers.appended.push_back(writer.take());
  return static_cast<int>(buffers.size()) - 1;
}

void write_views(State& state, const Plan& plan, int buffer) {
  if (state.views.empty()) return;
  ArrayChanges& views = state.array("bufferViews");
  for (const PendingView& view : state.views) {
    json::Writer writer;
    writer.begin_object().member("buffer", buffer);
    writer.member("byteOffset", plan.base + view.offset).member("byteLength", view.length);
    if (view.target != 0) writer.member("target", view.target);
    writer.end_object();
    views.set(static_cast<std::size_t>(view.index), writer.take());
  }
}

/// Files beside the input that buffers and images name, but for a buffer that became part of the
/// output.
std::vector<std::string> referenced_files(State& state, bool without_first) {
  std::vector<std::string> names;
  for (const char* array : {"buffers", "images"}) {
    const ArrayChanges& changes = state.array(array);
    for (std::size_t i = 0; i < changes.kept; ++i) {
      if (without_first && i == 0 && std::string_view(array) == "buffers") continue;
      const auto uri = changes.original[i]["uri"].string();
      if (!uri || is_data_uri(*uri) || is_absolute_uri(*uri)) continue;
      const auto name = percent_decoded(*uri);
      if (name && std::find(names.begin(), names.end(), *name) == names.end())
        names.push_back(*name);
    }
  }
  return names;
}

void append_uint32(std::string& out, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 255);
}

/// Header and JSON chunk, BIN in pieces, the chunks that followed it.
void lay_out_glb(Output& output, const State& state, const Plan& plan, std::string json) {
  const bool has_bin = plan.home == Plan::Home::bin && (plan.verbatim || plan.length > 0);
  json.resize(aligned(json.size()), ' ');
  const std::uint64_t bin = plan.verbatim ? state.file.bin.size() : aligned(plan.length);
  std::uint64_t total = 12 + 8 + json.size() + (has_bin ? 8 + bin : 0);
  for (std::string_view chunk : state.file.other_chunks) total += chunk.size();

  std::string head = "glTF";
  append_uint32(head, 2);
  append_uint32(head, total);
  append_uint32(head, json.size());
  head += "JSON";
  std::string bin_head;
  append_uint32(bin_head, bin);
  bin_head += std::string_view("BIN\0", 4);
  output.owned = {std::move(head),           std::move(json), std::move(bin_head),
                  zeros(plan.prefix.size()), state.data,      zeros(plan.length)};
  output.pieces = {output.owned[0], output.owned[1]};
  if (has_bin && plan.verbatim) {
    output.pieces.insert(output.pieces.end(), {output.owned[2], state.file.bin});
  } else if (has_bin) {
    output.pieces.insert(output.pieces.end(), {output.owned[2], plan.prefix, output.owned[3]});
    if (!state.data.empty())
      output.pieces.insert(output.pieces.end(), {output.owned[4], output.owned[5]});
  }
  for (std::string_view chunk : state.file.other_chunks) output.pieces.push_back(chunk);
}

/// The rig's buffer in one string, for a file of its own.
std::string rig_buffer(const State& state, const Plan& plan) {
  std::string bytes(plan.prefix);
  if (!state.data.empty()) bytes += zeros(plan.prefix.size()) + state.data;
  return bytes;
}

std::string whole_json(const State& state, bool binary) {
  const std::string_view text = state.file.json.text();
  const json::Value root = state.file.root();
  std::string out(text.substr(0, root.begin()));
  out += patched_json(state);
  std::string_view rest = text.substr(root.end());
  if (binary)
    while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
  return out.append(rest);
}

Output copy_of(const File& file) {
  Output output;
  output.pieces = {*file.whole};
  output.unchanged = true;
  return output;
}

}  // namespace

std::uint64_t Output::size() const {
  std::uint64_t total = 0;
  for (std::string_view piece : pieces) total += piece.size();
  return total;
}

std::string patched_json(const State& state) {
  Splice root(state.file.root());
  for (const auto& [name, changes] : state.arrays) {
    if (!changes.touched()) continue;
    if (changes.size() == 0) {
      root.set(name, "");
    } else if (root.find(name) < 0) {
      root.set(name, "[" + join(changes.appended, ",") + "]");
    } else {
      Splice array(state.file.root()[name]);
      for (const auto& [index, text] : changes.changed) array.replace(index, text);
      array.truncate(changes.kept);
      for (const std::string& text : changes.appended) array.append(text);
      root.set(name, array.text());
    }
  }
  for (const auto& [name, text] : state.members) root.set(name, text);
  return root.text();
}

std::optional<Output> Patch::finish(bool binary, Diagnostics& diagnostics) {
  State& state = *state_;
  cut_buffers(state);
  const Plan plan = make_plan(state, binary);
  Output output;
  std::string uri;
  if (plan.home == Plan::Home::file) {
    std::string bytes = rig_buffer(state, plan);
    uri = "rigc_" + hex16(hash64(bytes)) + ".bin";
    output.extra_files.push_back({uri, std::move(bytes)});
  }
  if (plan.home != Plan::Home::none) write_views(state, plan, write_buffer(state, plan, uri));

  std::string json = whole_json(state, binary);
  const bool same_json = json == whole_json(State(file_), binary);
  if (binary == file_.binary && same_json && (plan.verbatim || plan.home == Plan::Home::none))
    output = copy_of(file_);
  else if (binary)
    lay_out_glb(output, state, plan, std::move(json));
  else {
    output.owned.push_back(std::move(json));
    output.pieces.push_back(output.owned[0]);
    if (!file_.other_chunks.empty())
      diagnostics.report(codes::kChunksLost, Place(file_.path),
                         "a .gltf has no place for the extra chunks of this .glb");
  }
  output.copies = referenced_files(state, plan.first);
  if (binary && output.size() > UINT32_MAX) {
    diagnostics.report(codes::kGlbTooLarge, Place(file_.path),
                       "the output would have more than 4 GiB, which a .glb cannot hold",
                       "write a .gltf instead");
    return std::nullopt;
  }
  return output;
}

}  // namespace rigc::gltf
