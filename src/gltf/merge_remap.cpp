// SPDX-License-Identifier: MIT
// Walks a file and edits every index that merge_table.h knows. Test:
// tests/gltf/merge_table_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "gltf/merge_codes.h"
#include "gltf/merge_places.h"
#include "gltf/merge_table.h"

namespace rigc::gltf {
namespace {

using json::Value;

constexpr std::string_view kOrphan = "orphan:";

/// Calls `at` for every object of extensions: name, content, top-level array that it is in (empty
/// at the root).
template <class At>
void walk_extensions(const Value& value, std::string_view place, At& at) {
  for (const auto& [key, member] : value.members()) {
    if (key == "extras") continue;
    if (key != "extensions") {
      if (!member.is_number() && !member.is_string()) walk_extensions(member, place, at);
      continue;
    }
    for (const auto& [name, content] : member.members()) {
      at(name, content, place);
      if (name != "RIGC_rig") walk_extensions(content, place, at);
    }
  }
  if (!value.is_array()) return;
  for (const Value& item : value.items())
    if (!item.is_number()) walk_extensions(item, place, at);
}

template <class At>
void walk_file(const File& file, At at) {
  for (const auto& [key, member] : file.root().members()) {
    const bool counted =
        std::find(std::begin(kTopLevel), std::end(kTopLevel), key) != std::end(kTopLevel);
    if (key != "extensions" && key != "extras")
      walk_extensions(member, counted ? key : std::string_view(), at);
  }
  for (const auto& [name, content] : file.root()["extensions"].members()) {
    at(name, content, {});
    if (name != "RIGC_rig") walk_extensions(content, {}, at);
  }
}

class Remap {
 public:
  Remap(const File& file, const Places& places, Edits& edits, Diagnostics& diagnostics)
      : file_(file), places_(places), edits_(edits), diagnostics_(diagnostics) {}

  bool run() {
    const std::size_t errors = diagnostics_.errors();
    for (const std::string_view array : kTopLevel) {
      const auto& rules = rules_of(array);
      for (const Value& element : file_.root()[array].items())
        for (const IndexRule* rule : rules) follow(element, rule->path, rule->array);
    }
    for (const Value& node : file_.root()["nodes"].items()) renumber(node["extras"]["rigc"]);
    walk_file(file_, [&](std::string_view name, const Value& content, std::string_view place) {
      for (const IndexRule* rule : rules_of(name))
        if (rule->place.empty() || rule->place == place) follow(content, rule->path, rule->array);
    });
    return diagnostics_.errors() == errors;
  }

 private:
  void follow(const Value& value, std::string_view path, std::string_view array) {
    if (!value) return;
    if (path.empty()) return array == "pointer" ? set_pointer(value) : set_index(value, array);
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view step = path.substr(0, end);
    const std::string_view rest = end < path.size() ? path.substr(end + 1) : std::string_view();
    if (step != "*") return follow(value[step], rest, array);
    for (const Value& item : value.items()) follow(item, rest, array);
    for (const auto& [key, member] : value.members()) follow(member, rest, array);
  }

  void set_index(const Value& value, std::string_view array) {
    const auto index = value.integer();
    // Some writers say -1 where there is none.
    if (index && *index < 0) return;
    const int now = index ? places_.find(array, *index) : -1;
    if (now >= 0)
      edits_.replace(value, std::to_string(now));
    else
      fail(value, fmt::format("{} is no element of {}", printable(value.text(), 40), array));
  }

  void set_pointer(const Value& value) {
    const auto now = remapped_pointer(value.string().value_or(""), places_);
    if (now)
      edits_.replace(value, json::quote(*now));
    else
      fail(value,
           fmt::format("{} leads to nothing that a merge can follow", printable(value.text(), 80)));
  }

  void renumber(const Value& mark) {
    const auto text = mark.string();
    const auto now = text ? renumbered(*text, places_) : std::nullopt;
    if (now) edits_.replace(mark, json::quote(*now));
  }

  void fail(const Value& at, std::string message) {
    diagnostics_.report(codes::kMergeIndex, Place(file_.path, at.pointer()), std::move(message));
  }

  const File& file_;
  const Places& places_;
  Edits& edits_;
  Diagnostics& diagnostics_;
};

}  // namespace

int Places::find(std::string_view array, std::int64_t index) const {
  const auto found = arrays.find(array);
  if (found == arrays.end() || index < 0) return -1;
  const auto at = static_cast<std::uint64_t>(index);
  return at < found->second.size() ? found->second[at] : -1;
}

bool check_extensions(const File& file, Diagnostics& diagnostics) {
  std::set<std::string, std::less<>> unknown;
  const auto refuse = [&](std::string_view name, const Value& at) {
    if (is_known_extension(name) || !unknown.emplace(name).second) return;
    diagnostics.report(
        codes::kMergeExtension, Place(file.path, at.pointer()),
        fmt::format("\"{}\" may hold indices that rigc does not know", printable(name, 80)),
        "name this file first, or take the extension out of it");
  };
  walk_file(file, [&](std::string_view name, const Value& content, std::string_view) {
    refuse(name, content);
  });
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    for (const Value& name : file.root()[list].items()) refuse(name.string().value_or(""), name);
  return unknown.empty();
}

bool remap(const File& file, const Places& places, Edits& edits, Diagnostics& diagnostics) {
  return Remap(file, places, edits, diagnostics).run();
}

std::optional<std::string> renumbered(const std::string& text, const Places& places) {
  const std::size_t begin = starts_with(text, kOrphan) ? kOrphan.size() : 0;
  const auto identity = parse_identity(std::string_view(text).substr(begin));
  if (!identity) return std::nullopt;
  const auto rig = places.rigs.find(identity->rig);
  if (rig == places.rigs.end()) return std::nullopt;
  return text.substr(0, begin) + std::to_string(rig->second) + text.substr(text.find(':', begin));
}

std::optional<std::string> remapped_pointer(const std::string& pointer, const Places& places) {
  std::vector<std::string_view> steps = split(pointer, '/');
  if (steps.size() < 2 || !steps[0].empty()) return std::nullopt;
  const bool extension = steps[1] == "extensions";
  const std::size_t at = extension ? 4 : 2;  // of the index
  std::string array(steps[1]);
  if (extension && steps.size() > 3) array = std::string(steps[2]) + "." + std::string(steps[3]);
  const auto united =
      extension && steps.size() > 2 ? united_arrays(steps[2]) : std::vector<std::string_view>();
  // What only one file can have moves as it is.
  if (extension && steps.size() > 2 && united.empty() && is_known_extension(steps[2]))
    return pointer;
  if (steps.size() <= at) return std::nullopt;
  const auto index = parse_integer(steps[at]);
  const int now = index ? places.find(array, *index) : -1;
  if (now < 0) return std::nullopt;
  const std::string number = std::to_string(now);
  steps[at] = number;
  std::string out;
  for (std::size_t i = 1; i < steps.size(); ++i) out += "/" + std::string(steps[i]);
  return out;
}

std::vector<std::uint32_t> rig_ids(const File& file, const std::vector<Rig>& rigs) {
  std::set<std::uint32_t> ids;
  for (const Rig& rig : rigs) ids.insert(rig.id);
  for (const Value& node : file.root()["nodes"].items()) {
    std::string_view mark;
    const auto text = node["extras"]["rigc"].string();
    if (text) mark = *text;
    if (starts_with(mark, kOrphan)) mark.remove_prefix(kOrphan.size());
    if (const auto identity = parse_identity(mark)) ids.insert(identity->rig);
  }
  return {ids.begin(), ids.end()};
}

}  // namespace rigc::gltf
