// SPDX-License-Identifier: MIT
// Gathers changes to a file by element; patch_finish.cpp writes them.
// Test: tests/gltf/patch_test.cpp
#include "gltf/patch.h"

#include <algorithm>
#include <cassert>

#include "gltf/patch_state.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

constexpr std::string_view kMark = R"("extras":{"rigc":{"free":true}})";

/// An element that nothing uses any more but whose index must stay. `first` and `second` are
/// accessors of ours that only placeholders use; one accessor must not serve for two purposes.
std::string placeholder(std::string_view array, int first, int second) {
  std::string text;
  if (array == "meshes")
    text = R"("primitives":[{"mode":0,"attributes":{"POSITION":)" + std::to_string(first) + "}}],";
  if (array == "skins") text = R"("joints":[0],)";
  if (array == "accessors") text = R"("componentType":5126,"count":1,"type":"SCALAR",)";
  if (array == "bufferViews") text = R"("buffer":0,"byteLength":1,)";
  if (array == "animations")
    text = R"("channels":[{"sampler":0,"target":{"path":"weights"}}],"samplers":[{"input":)" +
           std::to_string(first) + R"(,"output":)" + std::to_string(second) + "}],";
  return "{" + text + std::string(kMark) + "}";
}

/// An accessor of one element, all zeros, without bytes.
std::string zero_accessor(std::string_view type, std::string_view zeros) {
  json::Writer writer;
  writer.begin_object().member("componentType", 5126).member("count", 1).member("type", type);
  writer.key("min").raw(zeros).key("max").raw(zeros).end_object();
  std::string text = writer.take();
  text.pop_back();
  return text + "," + std::string(kMark) + "}";
}

std::string child_list(const std::string& list, int child) {
  if (list.empty()) return "[" + std::to_string(child) + "]";
  Diagnostics none;
  const auto document = json::parse(list, "", 0, none);
  assert(document);
  Splice splice(document->root());
  splice.append(std::to_string(child));
  return splice.text();
}

/// The list without every mention of `child`; empty where nothing is left.
std::string without_child(const std::string& list, int child) {
  Diagnostics none;
  const auto document = json::parse(list, "", 0, none);
  assert(document);
  Splice splice(document->root());
  const auto items = document->root().items();
  for (std::size_t i = items.size(); i-- > 0;)
    if (items[i].integer() == child) splice.erase(i);
  return splice.size() == 0 ? std::string() : splice.text();
}

/// Text of a member of the object `text`, empty where it is missing.
std::string member_of(const std::string& text, std::string_view key) {
  Diagnostics none;
  const auto document = json::parse(text, "", 0, none);
  assert(document);
  return std::string(document->root()[key].text());
}

}  // namespace

std::string ArrayChanges::text(std::size_t index) const {
  if (index >= kept) return appended[index - kept];
  const auto found = changed.find(index);
  return found != changed.end() ? found->second : std::string(original[index].text());
}

void ArrayChanges::set(std::size_t index, std::string json) {
  if (index >= kept)
    appended[index - kept] = std::move(json);
  else if (original[index].text() == json)
    changed.erase(index);
  else
    changed[index] = std::move(json);
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

std::string Patch::State::member(std::string_view name) const {
  for (const auto& [key, text] : members)
    if (key == name) return text;
  return std::string(file.root()[name].text());
}

std::string_view Patch::State::original_extras(int node) const {
  const ArrayChanges* nodes = find("nodes");
  const auto index = static_cast<std::size_t>(node);
  if (!nodes || index >= nodes->original.size()) return {};
  return nodes->original[index]["extras"].text();
}

void Patch::State::set_member(std::string_view name, std::string json) {
  for (auto& [key, text] : members) {
    if (key != name) continue;
    text = std::move(json);
    return;
  }
  members.emplace_back(std::string(name), std::move(json));
}

Patch::Patch(const File& file) : file_(file), state_(std::make_shared<State>(file)) {}

int Patch::append(std::string_view array, std::string json) {
  ArrayChanges& changes = state_->array(array);
  changes.appended.push_back(std::move(json));
  return static_cast<int>(changes.size()) - 1;
}

int Patch::append_view(std::string_view data, int target) {
  State& state = *state_;
  state.data.resize((state.data.size() + 3) / 4 * 4, '\0');
  PendingView view;
  view.offset = state.data.size();
  view.length = data.size();
  view.target = target;
  view.index = append("bufferViews", std::string());
  state.data += data;
  state.views.push_back(view);
  return view.index;
}

int Patch::append(NewAccessor accessor) {
  json::Writer writer;
  writer.begin_object();
  if (!accessor.name.empty()) writer.member("name", accessor.name);
  writer.member("bufferView", append_view(accessor.data, accessor.target));
  writer.member("componentType", static_cast<int>(accessor.component));
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

std::string Patch::element(std::string_view array, int index) const {
  assert(index >= 0 && index < count(array));
  return state_->array(array).text(static_cast<std::size_t>(index));
}

int Patch::State::zeros(std::string_view purpose) {
  for (const auto& [name, index] : zero_accessors)
    if (name == purpose) return index;
  ArrayChanges& accessors = array("accessors");
  accessors.appended.push_back(purpose == "position" ? zero_accessor("VEC3", "[0,0,0]")
                                                     : zero_accessor("SCALAR", "[0]"));
  zero_accessors.emplace_back(purpose, static_cast<int>(accessors.size()) - 1);
  return zero_accessors.back().second;
}

void Patch::replace(std::string_view array, int index, std::string json) {
  assert(index >= 0 && index < count(array));
  if (json.empty()) {
    int first = 0, second = 0;
    if (array == "meshes") first = state_->zeros("position");
    if (array == "animations") {
      first = state_->zeros("input");
      second = state_->zeros("output");
    }
    json = placeholder(array, first, second);
  }
  state_->array(array).set(static_cast<std::size_t>(index), std::move(json));
}

void Patch::truncate(std::string_view array, int size) {
  if (size >= count(array)) return;
  ArrayChanges& changes = state_->array(array);
  const auto keep = static_cast<std::size_t>(size);
  changes.appended.resize(keep > changes.kept ? keep - changes.kept : 0);
  changes.kept = std::min(changes.kept, keep);
  changes.changed.erase(changes.changed.lower_bound(keep), changes.changed.end());
  if (array == "accessors")
    std::erase_if(state_->zero_accessors, [&](const auto& entry) { return entry.second >= size; });
  if (array == "bufferViews")
    std::erase_if(state_->views, [&](const PendingView& view) { return view.index >= size; });
}

void Patch::truncate_buffer(std::uint64_t byte_length) { state_->buffer_length = byte_length; }

std::uint64_t Patch::buffer_length() const {
  if (state_->buffer_length) return *state_->buffer_length;
  const auto buffers = file_.root()["buffers"].items();
  if (buffers.empty()) return 0;
  return static_cast<std::uint64_t>(buffers[0]["byteLength"].integer().value_or(0));
}

void Patch::set_member(std::string_view array, int index, std::string_view member,
                       std::string json) {
  const std::string now = element(array, index);
  state_->array(array).set(static_cast<std::size_t>(index),
                           with_member(now, member, std::move(json)));
}

void Patch::add_child(int node, int child) {
  if (node >= 0) {
    const std::string list = member_of(element("nodes", node), "children");
    set_member("nodes", node, "children", child_list(list, child));
    return;
  }
  if (count("scenes") == 0) {
    append("scenes", "{}");
    state_->set_member("scene", "0");
  }
  const int scene = static_cast<int>(file_.root()["scene"].integer().value_or(0));
  const std::string list = member_of(element("scenes", scene), "nodes");
  set_member("scenes", scene, "nodes", child_list(list, child));
}

void Patch::remove_child(int node, int child) {
  const std::string_view array = node >= 0 ? "nodes" : "scenes";
  const std::string_view member = node >= 0 ? "children" : "nodes";
  const int first = node >= 0 ? node : 0;
  const int last = node >= 0 ? node : count("scenes") - 1;
  for (int i = first; i <= last; ++i) {
    const std::string list = member_of(element(array, i), member);
    if (list.empty()) continue;
    const std::string rest = without_child(list, child);
    if (rest != list) set_member(array, i, member, rest);
  }
}

void Patch::set_extra(int node, std::string_view key, std::string json) {
  const std::string extras = member_of(element("nodes", node), "extras");
  if (extras.empty()) {
    if (json.empty()) return;
    set_member("nodes", node, "extras", "{" + json::quote(key) + ":" + json + "}");
    return;
  }
  if (extras.front() != '{') return;
  std::string changed = with_member(extras, key, std::move(json));
  if (changed == extras) return;
  if (is_empty_container(changed) && !is_empty_container(state_->original_extras(node)))
    changed.clear();
  set_member("nodes", node, "extras", std::move(changed));
}

std::string Patch::root_extension(std::string_view name) const {
  const std::string extensions = state_->member("extensions");
  return extensions.empty() ? std::string() : member_of(extensions, name);
}

void Patch::set_root_extension(std::string_view name, std::string json) {
  const std::string extensions = state_->member("extensions");
  const bool removes = json.empty();
  if (extensions.empty() && removes) return drop_extension(name);
  std::string changed = with_member(extensions.empty() ? "{}" : extensions, name, std::move(json));
  if (removes && is_empty_container(changed) &&
      !is_empty_container(file_.root()["extensions"].text()))
    changed.clear();
  state_->set_member("extensions", std::move(changed));
  removes ? drop_extension(name) : use_extension(name);
}

void Patch::use_extension(std::string_view name) {
  const std::string used = state_->member("extensionsUsed");
  if (used.empty()) return state_->set_member("extensionsUsed", "[" + json::quote(name) + "]");
  Diagnostics none;
  const auto document = json::parse(used, "", 0, none);
  assert(document);
  for (const json::Value& entry : document->root().items())
    if (entry.string() == name) return;
  Splice splice(document->root());
  splice.append(json::quote(name));
  state_->set_member("extensionsUsed", splice.text());
}

void Patch::drop_extension(std::string_view name) {
  const std::string used = state_->member("extensionsUsed");
  if (used.empty()) return;
  Diagnostics none;
  const auto document = json::parse(used, "", 0, none);
  assert(document);
  Splice splice(document->root());
  const auto entries = document->root().items();
  for (std::size_t i = entries.size(); i-- > 0;)
    if (entries[i].string() == name) splice.erase(i);
  state_->set_member("extensionsUsed", splice.size() == 0 ? std::string() : splice.text());
}

}  // namespace rigc::gltf
