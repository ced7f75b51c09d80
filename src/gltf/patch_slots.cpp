// SPDX-License-Identifier: MIT
// Places that nothing uses: cut at the end of an array, else a minimal valid element marked ours,
// which the next patch finds and gives out again. Test: tests/lossless/rounds_test.cpp
#include "base/text.h"
#include "gltf/patch_state.h"

namespace rigc::gltf {
namespace {

/// Ends a placeholder's text.
constexpr std::string_view kMark = R"("extras":{"rigc":{"free":true}}})";

enum class Zeros { positions, times, values };

/// An accessor of one element, all zeros, without bytes. One accessor must not serve two purposes.
std::string zero_accessor(Zeros purpose) {
  const bool vector = purpose == Zeros::positions;
  const std::string_view bounds = vector ? "[0,0,0]" : "[0]";
  json::Writer writer;
  writer.begin_object();
  if (purpose == Zeros::values) writer.member("name", "values");
  writer.member("componentType", 5126)
      .member("count", 1)
      .member("type", vector ? "VEC3" : "SCALAR");
  writer.key("min").raw(bounds).key("max").raw(bounds).end_object();
  std::string text = writer.take();
  text.back() = ',';
  return text.append(kMark);
}

/// The accessor of zeros that the file or the patch has, else a new one.
int zeros(Patch::State& state, Zeros purpose) {
  ArrayChanges& accessors = state.slots("accessors");
  const std::string text = zero_accessor(purpose);
  for (std::size_t i = 0; i < accessors.size(); ++i)
    if (accessors.text(i) == text) return static_cast<int>(i);
  if (accessors.free.empty()) {
    accessors.appended.push_back(text);
    return static_cast<int>(accessors.size()) - 1;
  }
  const std::size_t index = *accessors.free.begin();
  accessors.free.erase(accessors.free.begin());
  accessors.set(index, text);
  return static_cast<int>(index);
}

/// Releases accessors of zeros that no placeholder uses any more.
void release_zeros(Patch::State& state) {
  if (!state.find("accessors")) return;
  for (const char* array : {"meshes", "animations"}) {
    const ArrayChanges& changes = state.array(array);
    for (std::size_t i = 0; i < changes.size(); ++i)
      if (is_placeholder(array, changes.text(i))) return;
  }
  ArrayChanges& accessors = state.slots("accessors");
  const std::string texts[] = {zero_accessor(Zeros::positions), zero_accessor(Zeros::times),
                               zero_accessor(Zeros::values)};
  for (std::size_t i = 0; i < accessors.size(); ++i)
    for (const std::string& text : texts)
      if (accessors.text(i) == text) accessors.free.insert(i);
}

}  // namespace

std::string placeholder(std::string_view array, int first, int second) {
  std::string text;
  if (array == "meshes")
    text = R"("primitives":[{"mode":0,"attributes":{"POSITION":)" + std::to_string(first) + "}}],";
  if (array == "skins") text = R"("joints":[0],)";
  if (array == "accessors") text = R"("componentType":5126,"count":1,"type":"SCALAR",)";
  if (array == "bufferViews") text = R"("buffer":0,"byteLength":1,)";
  if (array == "buffers")
    text = R"("byteLength":1,"uri":"data:application/octet-stream;base64,AA==",)";
  if (array == "animations")
    text = R"("channels":[{"sampler":0,"target":{"path":"weights"}}],"samplers":[{"input":)" +
           std::to_string(first) + R"(,"output":)" + std::to_string(second) + "}],";
  return "{" + text + std::string(kMark);
}

bool is_placeholder(std::string_view array, std::string_view text) {
  // Accessors of zeros, which placeholders use, have the mark too.
  return ends_with(text, kMark) && (array != "accessors" || text == placeholder(array));
}

std::string free_view(std::size_t buffer, const Interval& bytes) {
  json::Writer writer;
  writer.begin_object().member("buffer", buffer);
  writer.member("byteOffset", bytes.begin).member("byteLength", bytes.end - bytes.begin);
  std::string text = writer.end_object().take();
  text.back() = ',';
  return text.append(kMark);
}

std::string Patch::State::new_placeholder(std::string_view name) {
  if (name == "meshes") return placeholder(name, zeros(*this, Zeros::positions));
  if (name != "animations") return placeholder(name);
  const int times = zeros(*this, Zeros::times);
  return placeholder(name, times, zeros(*this, Zeros::values));
}

void settle(Patch::State& state) {
  const auto settle_array = [&](std::string_view name, ArrayChanges& changes) {
    if (!changes.has_slots) return;
    changes.cut_tail();
    for (const std::size_t index : changes.free) {
      // What a view remembered as free may be used by now, or cut off.
      const bool stale = name == "bufferViews" && changes.text(index) != placeholder("bufferViews");
      if (stale || !is_placeholder(name, changes.text(index)))
        changes.set(index, state.new_placeholder(name));
    }
  };
  // Their placeholders need accessors.
  for (const char* name : {"meshes", "animations"})
    if (state.find(name)) settle_array(name, state.array(name));
  release_zeros(state);
  for (std::size_t i = 0; i < state.arrays.size(); ++i)
    settle_array(state.arrays[i].first, state.arrays[i].second);
}

}  // namespace rigc::gltf
