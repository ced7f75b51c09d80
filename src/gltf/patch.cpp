// SPDX-License-Identifier: MIT
// Gathers changes to a file by element; patch_members.cpp those inside of elements and of the root,
// patch_finish.cpp writes them. Test: tests/gltf/patch_test.cpp
#include "gltf/patch.h"

#include <algorithm>
#include <cassert>

#include "base/text.h"
#include "gltf/patch_state.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

/// Nodes that something in the file names.
std::vector<bool> named_nodes(const File& file, std::size_t count) {
  std::vector<bool> named(count, false);
  const auto name = [&](const json::Value& value) {
    const auto index = value.integer().value_or(-1);
    if (index >= 0 && index < static_cast<std::int64_t>(count))
      named[static_cast<std::size_t>(index)] = true;
  };
  const json::Value root = file.root();
  for (const json::Value& node : root["nodes"].items())
    for (const json::Value& child : node["children"].items()) name(child);
  for (const json::Value& scene : root["scenes"].items())
    for (const json::Value& node : scene["nodes"].items()) name(node);
  for (const json::Value& skin : root["skins"].items()) {
    name(skin["skeleton"]);
    for (const json::Value& joint : skin["joints"].items()) name(joint);
  }
  for (const json::Value& animation : root["animations"].items())
    for (const json::Value& channel : animation["channels"].items())
      name(channel["target"]["node"]);
  return named;
}

}  // namespace

std::string_view ArrayChanges::text(std::size_t index) const {
  if (index >= kept) return appended[index - kept];
  const auto found = changed.find(index);
  return found != changed.end() ? found->second : original[index].text();
}

void ArrayChanges::set(std::size_t index, std::string json) {
  if (index >= kept)
    appended[index - kept] = std::move(json);
  else if (original[index].text() == json)
    changed.erase(index);
  else
    changed[index] = std::move(json);
}

void ArrayChanges::truncate(std::size_t size) {
  appended.resize(size > kept ? size - kept : 0);
  kept = std::min(kept, size);
  changed.erase(changed.lower_bound(kept), changed.end());
  free.erase(free.lower_bound(size), free.end());
}

void ArrayChanges::cut_tail() {
  std::size_t end = size();
  while (end > 0 && free.count(end - 1)) --end;
  if (end < size()) truncate(end);
}

Patch::State::State(const File& the_file) : file(the_file) {
  const json::Value known = file.root()["extensions"]["RIGC_rig"]["before"];
  const auto set_length = [&](const json::Value& value) {
    before.length =
        static_cast<std::uint64_t>(std::max<std::int64_t>(value.integer().value_or(0), 0));
    if (before.length > 0) before.byte_length = value.text();
  };
  if (known.is_object()) {
    set_length(known["byteLength"]);
    if (known["bin"]) before.bin = unsigned_member(known, "bin");
    before.scenes = known["scenes"].boolean().value_or(true);
    for (const json::Value& pointer : known["empty"].items())
      before.empty.insert(pointer.string().value_or(""));
    return;
  }
  const auto buffers = file.root()["buffers"].items();
  if (!buffers.empty()) set_length(buffers[0]["byteLength"]);
  if (file.bin) before.bin = file.bin->size();
  before.scenes = static_cast<bool>(file.root()["scenes"]);
}

ArrayChanges& Patch::State::array(std::string_view name) {
  for (auto& [key, changes] : arrays)
    if (key == name) return changes;
  ArrayChanges changes;
  changes.original = file.root()[name].items();
  changes.kept = changes.original.size();
  return arrays.emplace_back(std::string(name), std::move(changes)).second;
}

const ArrayChanges* Patch::State::find(std::string_view name) const {
  for (const auto& [key, changes] : arrays)
    if (key == name) return &changes;
  return nullptr;
}

ArrayChanges& Patch::State::slots(std::string_view name) {
  ArrayChanges& changes = array(name);
  if (changes.has_slots) return changes;
  changes.has_slots = true;
  for (std::size_t i = 0; i < changes.kept; ++i)
    if (is_placeholder(name, changes.text(i))) changes.free.insert(i);
  if (name == "nodes" && !changes.free.empty()) {
    const std::vector<bool> named = named_nodes(file, changes.original.size());
    std::erase_if(changes.free, [&](std::size_t i) { return named[i]; });
  }
  if (name == "bufferViews")
    for (const std::size_t view : changes.free) release_bytes(view);
  return changes;
}

void Patch::State::release_bytes(std::size_t view) {
  const auto pending = std::find_if(views.begin(), views.end(), [&](const PendingView& other) {
    return other.index == static_cast<int>(view);
  });
  if (pending != views.end()) {
    views.erase(pending);
    return;
  }
  const ArrayChanges& changes = array("bufferViews");
  if (view >= changes.kept || changes.text(view) == placeholder("bufferViews")) return;
  const json::Value& value = changes.original[view];
  const std::uint64_t begin = unsigned_member(value, "byteOffset");
  free_bytes[static_cast<std::size_t>(unsigned_member(value, "buffer"))].push_back(
      {begin, begin + unsigned_member(value, "byteLength")});
}

Patch::Patch(const File& file) : file_(file), state_(std::make_shared<State>(file)) {}

int Patch::append(std::string_view array, std::string json) {
  ArrayChanges& changes = state_->slots(array);
  std::size_t index = changes.size();
  if (!changes.free.empty()) {
    index = *changes.free.begin();
    changes.free.erase(changes.free.begin());
    changes.set(index, std::move(json));
  } else {
    if (index == 0) state_->fills("/" + std::string(array), file_.root()[array].text());
    changes.appended.push_back(std::move(json));
  }
  changes.given.push_back(static_cast<int>(index));
  return changes.given.back();
}

int Patch::append_view(std::string_view data, int target) {
  State& state = *state_;
  PendingView view;
  view.offset = state.data.size();
  view.length = data.size();
  view.target = target;
  view.index = append("bufferViews", std::string());
  state.data += data;
  state.views.push_back(view);
  return view.index;
}

void Patch::append_bytes(Bytes bytes, std::function<void(int buffer, std::uint64_t at)> placed) {
  State& state = *state_;
  // The buffer without a URI comes first: no other may take its place.
  if (count("buffers") == 0) state.array("buffers").appended.emplace_back();
  PendingView view{-1, 0, bytes.size()};
  view.bytes = std::move(bytes);
  view.placed = std::move(placed);
  state.views.push_back(std::move(view));
}

int Patch::append(NewAccessor accessor) {
  json::Writer writer;
  writer.begin_object();
  if (!accessor.name.empty()) writer.member("name", accessor.name);
  writer.member("bufferView", append_view(accessor.data, accessor.target));
  writer.member("componentType", static_cast<int>(accessor.component));
  if (accessor.normalised) writer.member("normalized", true);
  writer.member("count", accessor.count).member("type", accessor.type);
  if (!accessor.min.empty()) writer.key("min").numbers(accessor.min.data(), accessor.min.size());
  if (!accessor.max.empty()) writer.key("max").numbers(accessor.max.data(), accessor.max.size());
  writer.end_object();
  return append("accessors", writer.take());
}

int Patch::count(std::string_view array) const {
  if (const ArrayChanges* changes = state_->find(array)) return static_cast<int>(changes->size());
  return static_cast<int>(file_.root()[array].size());
}

std::vector<int> Patch::given(std::string_view array) const {
  const ArrayChanges* changes = state_->find(array);
  return changes ? changes->given : std::vector<int>();
}

std::string Patch::element(std::string_view array, int index) const {
  assert(index >= 0 && index < count(array));
  return std::string(state_->array(array).text(static_cast<std::size_t>(index)));
}

void Patch::replace(std::string_view array, int index, std::string json) {
  assert(index >= 0 && index < count(array));
  if (json.empty()) json = state_->new_placeholder(array);
  state_->array(array).set(static_cast<std::size_t>(index), std::move(json));
}

void Patch::release(std::string_view array, int index) {
  ArrayChanges& changes = state_->slots(array);
  const auto at = static_cast<std::size_t>(index);
  if (at >= changes.size() || changes.free.count(at)) return;
  if (array == "bufferViews") state_->release_bytes(at);
  changes.free.insert(at);
  changes.cut_tail();
}

void Patch::truncate(std::string_view array, int size) {
  for (int i = count(array); i-- > size;) release(array, i);
}

}  // namespace rigc::gltf
