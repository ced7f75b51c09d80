// SPDX-License-Identifier: MIT
// Which buffer takes a Patch's bytes and where in it they go: into bytes of ours that nothing uses
// any more, else to the end; free bytes at the end are cut. Test: tests/lossless/rounds_test.cpp
#include <algorithm>

#include "base/ids.h"
#include "base/text.h"
#include "gltf/patch_state.h"

namespace rigc::gltf {
namespace {

using State = Patch::State;
using Intervals = std::vector<Interval>;
using Home = BytePlan::Home;

std::uint64_t aligned(std::uint64_t size, std::uint64_t step = 4) {
  return (size + step - 1) / step * step;
}

void sort(Intervals& list) {
  std::sort(list.begin(), list.end(), [](const Interval& a, const Interval& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
}

/// Sorted and joined where not more than the padding between views lies between them.
Intervals joined(Intervals list) {
  sort(list);
  Intervals out;
  for (const Interval& next : list) {
    if (!out.empty() && next.begin < out.back().end + 4)
      out.back().end = std::max(out.back().end, next.end);
    else
      out.push_back(next);
  }
  return out;
}

/// `list` without what `kept` covers; both sorted.
Intervals without(const Intervals& list, const Intervals& kept) {
  Intervals out;
  for (const Interval& free : list) {
    std::uint64_t begin = free.begin;
    for (const Interval& other : kept) {
      if (other.end <= begin || other.begin >= free.end) continue;
      if (other.begin > begin) out.push_back({begin, other.begin});
      begin = std::max(begin, other.end);
    }
    if (begin < free.end) out.push_back({begin, free.end});
  }
  return out;
}

/// Bytes of a buffer that views of the file use, sorted. Extensions of views name buffers in the
/// same words (meshopt).
Intervals kept_bytes(State& state, std::size_t buffer) {
  Intervals out;
  const auto add = [&](const json::Value& view) {
    if (view["buffer"].integer() != static_cast<std::int64_t>(buffer)) return;
    const std::uint64_t begin = unsigned_member(view, "byteOffset");
    out.push_back({begin, begin + unsigned_member(view, "byteLength")});
  };
  const ArrayChanges& views = state.array("bufferViews");
  for (std::size_t i = 0; i < views.kept; ++i) {
    if (views.free.count(i) || views.changed.count(i)) continue;
    add(views.original[i]);
    for (const auto& [name, extension] : views.original[i]["extensions"].members()) add(extension);
  }
  sort(out);
  return out;
}

Intervals free_bytes(State& state, std::size_t buffer) {
  const auto found = state.free_bytes.find(buffer);
  if (found == state.free_bytes.end()) return {};
  return without(joined(found->second), kept_bytes(state, buffer));
}

/// `rigc_0123456789abcdef.bin`.
bool is_own_file(const json::Value& buffer) {
  const std::string uri = buffer["uri"].string().value_or("");
  return uri.size() == 25 && starts_with(uri, "rigc_") && ends_with(uri, ".bin") &&
         parse_hex16(std::string_view(uri).substr(5, 16));
}

/// Chooses the buffer. What the input has there becomes the prefix, whole.
void choose_home(State& state, bool binary, BytePlan& plan) {
  const File& file = state.file;
  const ArrayChanges& buffers = state.array("buffers");
  const std::size_t count = buffers.original.size();
  const bool in_bin = file.bin && (count == 0 || !buffers.original[0]["uri"]);
  const auto take = [&](Home home, int buffer, Bytes prefix) {
    plan.home = home;
    plan.buffer = buffer;
    plan.prefix = std::move(prefix);
  };
  if (binary && file.bin) plan.chunk = file.bin->size();
  const bool concerned = !state.views.empty() || state.free_bytes.count(0) != 0;
  if (binary && file.binary && in_bin) {
    if (concerned) take(Home::bin, count == 0 ? -1 : 0, *file.bin);
    return;
  }
  if (count > 0 && (binary ? !file.binary && !file.buffers[0].bytes.empty() : in_bin))
    return take(binary ? Home::bin : Home::file, 0, file.buffers[0].bytes);
  for (std::size_t i = count; i-- > 0;) {
    if (!is_own_file(buffers.original[i])) continue;
    if (!state.views.empty() || state.free_bytes.count(i))
      take(Home::file, static_cast<int>(i), file.buffers[i].bytes);
    return;
  }
  if (!state.views.empty()) take(binary && count == 0 ? Home::bin : Home::file, -1, {});
}

/// Cuts free bytes at the end. Where all that was ever added goes, the buffer becomes what it was.
void cut_end(const State& state, BytePlan& plan) {
  const std::uint64_t total = plan.length;
  if (plan.free.empty() || plan.free.back().end < total) return;
  std::uint64_t cut = plan.free.back().begin;
  // BIN is buffer 0, and where others follow it stays.
  const bool has_others = state.file.buffers.size() > 1;
  if (cut == 0 && has_others && plan.home == Home::bin) cut = std::min<std::uint64_t>(total, 4);
  plan.free.back().end = cut;
  if (plan.free.back().begin == cut) plan.free.pop_back();
  plan.prefix = plan.prefix.part(0, cut);
  plan.length = cut;
  plan.chunk = cut == 0 ? std::nullopt : std::optional(aligned(cut));
  plan.byte_length = cut == 0 ? "" : std::to_string(cut);
  plan.changed = true;
  const Before& before = state.before;
  const bool ours_alone =
      plan.buffer >= 0 &&
      is_own_file(state.file.root()["buffers"].items()[static_cast<std::size_t>(plan.buffer)]);
  if (ours_alone || cut != before.bin.value_or(aligned(before.length))) return;
  if (before.length > cut) return;
  const bool had_buffer = !before.byte_length.empty();
  if (had_buffer) plan.length = before.length;
  plan.byte_length = before.byte_length;
  plan.chunk = before.bin || had_buffer ? std::optional(cut) : std::nullopt;
}

/// Finds a place for each new view: the first hole that it fits into, else the end.
void place(const State& state, BytePlan& plan) {
  std::uint64_t end =
      plan.home == Home::bin && plan.chunk ? std::max(*plan.chunk, plan.length) : plan.length;
  for (std::size_t i = 0; i < state.views.size(); ++i) {
    const std::uint64_t length = state.views[i].length;
    const std::uint64_t step = state.views[i].alignment();
    const auto hole = std::find_if(plan.free.begin(), plan.free.end(), [&](const Interval& free) {
      return aligned(free.begin, step) + length <= free.end;
    });
    std::uint64_t at = aligned(end, step);
    if (hole != plan.free.end()) {
      at = aligned(hole->begin, step);
      hole->begin = std::min(aligned(at + length), hole->end);
      if (hole->begin == hole->end) plan.free.erase(hole);
    } else {
      end = plan.length = at + length;
      plan.byte_length = std::to_string(end);
      plan.chunk = aligned(end);
    }
    plan.placed.push_back({i, at, length});
    plan.changed = true;
  }
  std::sort(plan.placed.begin(), plan.placed.end(),
            [](const Placed& a, const Placed& b) { return a.at < b.at; });
}

}  // namespace

std::uint64_t unsigned_member(const json::Value& object, std::string_view key) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(object[key].integer().value_or(0), 0));
}

BytePlan plan_bytes(State& state, bool binary) {
  BytePlan plan;
  choose_home(state, binary, plan);
  if (plan.home == Home::none) return plan;
  const ArrayChanges& buffers = state.array("buffers");
  if (plan.buffer >= 0) {
    const auto index = static_cast<std::size_t>(plan.buffer);
    plan.length = state.file.buffers[index].bytes.size();
    plan.byte_length = buffers.original[index]["byteLength"].text();
    plan.free = free_bytes(state, index);
    if (plan.home == Home::bin && !plan.chunk) plan.chunk = aligned(plan.length);
    cut_end(state, plan);
  } else {
    plan.length = plan.prefix.size();
  }
  place(state, plan);
  return plan;
}

std::vector<Bytes> pieces_of(const State& state, const BytePlan& plan, std::uint64_t length) {
  std::vector<Bytes> pieces;
  std::uint64_t at = 0;
  const auto keep = [&](std::uint64_t until) {
    const std::uint64_t end = std::min(until, plan.prefix.size());
    if (at < end) pieces.push_back(plan.prefix.part(at, end - at));
    at = std::max(at, end);
    if (at < until) pieces.push_back(std::string(until - at, '\0'));
    at = until;
  };
  for (const Placed& placed : plan.placed) {
    keep(placed.at);
    const PendingView& view = state.views[placed.view];
    pieces.push_back(view.placed ? view.bytes
                                 : Bytes(state.data.substr(view.offset, placed.length)));
    at += placed.length;
  }
  keep(length);
  return pieces;
}

std::vector<std::pair<std::size_t, Interval>> remaining_bytes(State& state, const BytePlan& plan) {
  std::vector<std::pair<std::size_t, Interval>> out;
  for (const auto& [buffer, bytes] : state.free_bytes) {
    const bool home = static_cast<int>(buffer) == plan.buffer;
    ArrayChanges& buffers = state.slots("buffers");
    if (buffer >= buffers.original.size()) continue;
    const bool own = is_own_file(buffers.original[buffer]);
    if (home ? plan.byte_length.empty() : own && kept_bytes(state, buffer).empty())
      buffers.free.insert(buffer);
    else if (home || own)
      for (const Interval& free : home ? plan.free : free_bytes(state, buffer))
        out.emplace_back(buffer, free);
  }
  return out;
}

}  // namespace rigc::gltf
