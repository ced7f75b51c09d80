// SPDX-License-Identifier: MIT
// Changes of a Patch inside of elements and of the root object: members, children, extras,
// extensions. Test: tests/gltf/patch_test.cpp
#include "gltf/patch.h"
#include "gltf/patch_state.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

std::string with_item(const std::string& list, std::string item) {
  if (list.empty()) return "[" + item + "]";
  const json::Document document = parsed(list);
  Splice splice(document.root());
  splice.append(std::move(item));
  return splice.text();
}

/// The list without the items that `goes` says.
template <class Goes>
std::string without_items(const std::string& list, Goes goes) {
  const json::Document document = parsed(list);
  Splice splice(document.root());
  const auto items = document.root().items();
  for (std::size_t i = items.size(); i-- > 0;)
    if (goes(items[i])) splice.erase(i);
  return splice.text();
}

/// Text of a member of the object `text`, empty where it is missing.
std::string member_of(const std::string& text, std::string_view key) {
  const json::Document document = parsed(text);
  return std::string(document.root()[key].text());
}

std::string pointer_to(std::string_view array, int index, std::string_view member) {
  return "/" + std::string(array) + "/" + std::to_string(index) + "/" + std::string(member);
}

}  // namespace

std::string Before::text() const {
  json::Writer writer;
  writer.begin_object();
  if (!byte_length.empty()) writer.key("byteLength").raw(byte_length);
  if (bin) writer.key("bin").integer(static_cast<std::int64_t>(*bin));
  if (!scenes) writer.member("scenes", false);
  if (!empty.empty()) {
    writer.key("empty").begin_array();
    for (const std::string& pointer : empty) writer.value(pointer);
    writer.end_array();
  }
  return writer.end_object().take();
}

std::string Patch::before() const {
  // Filled after this was written.
  for (const char* member : {"extensions", "extensionsUsed", "buffers"})
    state_->fills("/" + std::string(member), state_->member(member));
  return state_->before.text();
}

std::string Patch::State::member(std::string_view name) const {
  for (const auto& [key, text] : members)
    if (key == name) return text;
  return std::string(file.root()[name].text());
}

void Patch::State::set_member(std::string_view name, std::string json) {
  for (auto& [key, text] : members) {
    if (key != name) continue;
    text = std::move(json);
    return;
  }
  members.emplace_back(std::string(name), std::move(json));
}

void Patch::State::fills(const std::string& pointer, std::string_view now) {
  if (!now.empty() && is_empty_container(now)) before.empty.insert(pointer);
}

std::string Patch::State::emptied(const std::string& pointer, std::string text) const {
  if (is_empty_container(text) && before.empty.count(pointer) == 0) text.clear();
  return text;
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
    state_->fills(pointer_to("nodes", node, "children"), list);
    set_member("nodes", node, "children", with_item(list, std::to_string(child)));
    return;
  }
  if (count("scenes") == 0) {
    append("scenes", "{}");
    state_->set_member("scene", "0");
  }
  add_root(static_cast<int>(file_.root()["scene"].integer().value_or(0)), child);
}

void Patch::add_root(int scene, int node) {
  const std::string list = member_of(element("scenes", scene), "nodes");
  state_->fills(pointer_to("scenes", scene, "nodes"), list);
  set_member("scenes", scene, "nodes", with_item(list, std::to_string(node)));
}

void Patch::remove_child(int node, int child) {
  const std::string_view array = node >= 0 ? "nodes" : "scenes";
  const std::string_view member = node >= 0 ? "children" : "nodes";
  const int first = node >= 0 ? node : 0;
  const int last = node >= 0 ? node : count("scenes") - 1;
  for (int i = first; i <= last; ++i) {
    const std::string list = member_of(element(array, i), member);
    if (list.empty()) continue;
    std::string rest =
        without_items(list, [&](const json::Value& item) { return item.integer() == child; });
    if (rest != list)
      set_member(array, i, member, state_->emptied(pointer_to(array, i, member), std::move(rest)));
  }
  // The scene that add_child made where there was none.
  if (node < 0 && !state_->before.scenes && count("scenes") == 1 && element("scenes", 0) == "{}") {
    truncate("scenes", 0);
    state_->set_member("scene", "");
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
  const std::string pointer = pointer_to("nodes", node, "extras");
  state_->fills(pointer, extras);
  std::string changed = with_member(extras, key, std::move(json));
  if (changed != extras)
    set_member("nodes", node, "extras", state_->emptied(pointer, std::move(changed)));
}

std::string Patch::root_extension(std::string_view name) const {
  const std::string extensions = state_->member("extensions");
  return extensions.empty() ? std::string() : member_of(extensions, name);
}

void Patch::set_root_extension(std::string_view name, std::string json) {
  const std::string extensions = state_->member("extensions");
  const bool removes = json.empty();
  state_->fills("/extensions", extensions);
  if (!extensions.empty() || !removes) {
    const json::Value read = state_->file.root()["extensions"];
    std::string changed;
    if (read && read.text() == extensions) {  // its members are known: RIGC_rig is large
      Splice splice(read);
      splice.set(name, std::move(json));
      changed = splice.text();
    } else {
      changed = with_member(extensions.empty() ? "{}" : extensions, name, std::move(json));
    }
    state_->set_member("extensions", state_->emptied("/extensions", std::move(changed)));
  }
  removes ? drop_extension(name) : use_extension(name);
}

void Patch::set_root_member(std::string_view name, std::string json) {
  state_->set_member(name, std::move(json));
}

std::string Patch::root_member(std::string_view name) const { return state_->member(name); }

void Patch::use_extension(std::string_view name) {
  const std::string used = state_->member("extensionsUsed");
  state_->fills("/extensionsUsed", used);
  if (!used.empty()) {
    const json::Document document = parsed(used);
    for (const json::Value& entry : document.root().items())
      if (entry.string() == name) return;
  }
  state_->set_member("extensionsUsed", with_item(used, json::quote(name)));
}

void Patch::drop_extension(std::string_view name) {
  const std::string used = state_->member("extensionsUsed");
  if (used.empty()) return;
  std::string rest =
      without_items(used, [&](const json::Value& entry) { return entry.string() == name; });
  if (rest != used) state_->set_member("extensionsUsed", state_->emptied("/extensionsUsed", rest));
}

}  // namespace rigc::gltf
