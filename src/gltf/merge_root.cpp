// SPDX-License-Identifier: MIT
// Scenes and members of the root of a file that comes to another. Test: tests/gltf/merge_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "gltf/merge_codes.h"
#include "gltf/merge_parts.h"
#include "gltf/merge_table.h"
#include "gltf/rig_json.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

using json::Value;

/// Reports what of the file has no place in the merged one.
void report_left_out(const Patch& patch, const File& file, Diagnostics& diagnostics) {
  const Value root = file.root();
  const json::Document asset = parsed(patch.root_member("asset"));
  const auto report = [&](const std::string& pointer, std::string_view what) {
    diagnostics.report(
        codes::kMergeLeftOut, Place(file.path, pointer),
        fmt::format("{} of {} does not come into the merged file", what, printable(file.path)));
  };
  for (const char* member : {"copyright", "extras", "extensions"}) {
    const Value mine = root["asset"][member];
    if (mine && mine.text() != asset.root()[member].text())
      report(mine.pointer(), fmt::format("\"asset.{}\"", member));
  }
  static constexpr std::string_view kKnown[] = {
      "asset", "extensions", "extensionsRequired", "extensionsUsed", "extras", "scene"};
  for (const auto& [name, value] : root.members()) {
    const auto has = [&, key = std::string_view(name)](const auto& list) {
      return std::find(std::begin(list), std::end(list), key) != std::end(list);
    };
    if (!has(kKnown) && !has(kTopLevel))
      report("/" + name, fmt::format("\"{}\"", printable(name, 60)));
  }
  if (!file.other_chunks.empty()) report("", "the chunks behind BIN");
}

void join_extras(Patch& patch, const File& file, Diagnostics& diagnostics) {
  const Value extras = file.root()["extras"];
  if (!extras) return;
  const std::string there = patch.root_member("extras");
  if (there.empty())
    patch.set_root_member("extras", std::string(extras.text()));
  else if (there != extras.text())
    diagnostics.report(codes::kMergeLeftOut, Place(file.path, "/extras"),
                       fmt::format("\"extras\" of the root of {} does not come into the merged "
                                   "file, which has others",
                                   printable(file.path)));
}

void join_names(Patch& patch, const File& file) {
  const Value root = file.root();
  for (const Value& name : root["extensionsUsed"].items())
    patch.use_extension(name.string().value_or(""));
  for (const Value& name : root["extensionsRequired"].items()) {
    const std::string there = patch.root_member("extensionsRequired");
    const json::Document document = parsed(there.empty() ? "[]" : there);
    const auto names = document.root().items();
    if (std::any_of(names.begin(), names.end(),
                    [&](const Value& other) { return other.string() == name.string(); }))
      continue;
    Splice list(document.root());
    list.append(std::string(name.text()));
    patch.set_root_member("extensionsRequired", list.text());
  }
}

/// Containers without members that rigs of the file filled, as they are now.
std::string with_empty(const std::string& before, const File& file, const Places& places) {
  const json::Document document = parsed(before);
  std::set<std::string> empty;
  for (const Value& pointer : document.root()["empty"].items())
    empty.insert(pointer.string().value_or(""));
  const Value theirs = file.root()["extensions"]["RIGC_rig"]["before"]["empty"];
  for (const Value& pointer : theirs.items())
    // Roots of a scene that joins another are not alone there.
    if (const auto now = remapped_pointer(pointer.string().value_or(""), places);
        now && !starts_with(*now, "/scenes/"))
      empty.insert(*now);
  if (empty.empty()) return before;
  json::Writer writer;
  writer.begin_array();
  for (const std::string& pointer : empty) writer.value(pointer);
  return with_member(before, "empty", writer.end_array().take());
}

/// The file's rigs behind those that are there.
void join_rigs(Patch& patch, const File& file, const Places& places, const Edits& edits) {
  const Value rigs = file.root()["extensions"]["RIGC_rig"]["rigs"];
  if (!rigs) return;
  const std::string before = with_empty(patch.before(), file, places);
  std::string there = patch.root_extension("RIGC_rig");
  if (there.empty()) {
    json::Writer writer;
    writer.begin_object().member("version", kRigVersionNumber).key("before").raw(before);
    there = writer.key("rigs").begin_array().end_array().end_object().take();
  }
  const json::Document document = parsed(there);
  Splice list(document.root()["rigs"]);
  for (const Value& rig : rigs.items()) list.append((list.size() ? "" : "\n") + edits.text(rig));
  Splice whole(document.root());
  whole.set("before", before);
  whole.set("rigs", list.text());
  patch.set_root_extension("RIGC_rig", whole.text());
}

class RootExtensions {
 public:
  RootExtensions(Patch& patch, const File& file, const Edits& edits, Diagnostics& diagnostics)
      : patch_(patch), file_(file), edits_(edits), diagnostics_(diagnostics) {}

  void join(const std::string& name, const Value& content) {
    const std::string there = patch_.root_extension(name);
    const AtRoot way = at_root(name);
    if (way == AtRoot::one && there == edits_.text(content)) return;
    if (way == AtRoot::first_only)
      return refuse(name, content, "its lists go by the order of the file's materials",
                    "name this file first");
    if (there.empty()) return patch_.set_root_extension(name, edits_.text(content));
    if (way == AtRoot::one)
      return refuse(name, content, "a file before has one too, and a file can have only one",
                    "take the extension out of one of the files");
    unite(name, parsed(there), content);
  }

 private:
  void unite(const std::string& name, const json::Document& there, const Value& content) {
    const auto united = united_arrays(name);
    Splice whole(there.root());
    for (const auto& [key, value] : content.members()) {
      const Value other = there.root()[key];
      const bool list = std::find(united.begin(), united.end(), key) != united.end();
      if (other && !list && other.text() != edits_.text(value))
        return refuse(name, value,
                      fmt::format("\"{}\" differs between the files", printable(key, 60)), "");
      if (!other) {
        whole.set(key, edits_.text(value));
      } else if (list) {
        Splice items(other);
        for (const Value& item : value.items()) items.append(edits_.text(item));
        whole.set(key, items.text());
      }
    }
    patch_.set_root_extension(name, whole.text());
  }

  void refuse(const std::string& name, const Value& at, std::string_view why, std::string hint) {
    diagnostics_.report(codes::kMergeTwice, Place(file_.path, at.pointer()),
                        fmt::format("\"{}\" cannot be merged: {}", printable(name, 80), why),
                        std::move(hint));
  }

  Patch& patch_;
  const File& file_;
  const Edits& edits_;
  Diagnostics& diagnostics_;
};

}  // namespace

void join_scenes(Patch& patch, const File& file, const Places& places, const Joins& joins) {
  if (joins.scene < 0) return;
  const auto scenes = file.root()["scenes"].items();
  const auto roots = scenes[static_cast<std::size_t>(joins.scene)]["nodes"].items();
  if (roots.empty()) return;
  const auto place = [&](const Value& root) {
    return places.find("nodes", root.integer().value_or(-1));
  };
  const int scene = default_scene(patch);
  patch.add_root(scene, place(roots.front()));
  const json::Document document = parsed(patch.element("scenes", scene));
  Splice list(document.root()["nodes"]);
  for (std::size_t i = 1; i < roots.size(); ++i) list.append(std::to_string(place(roots[i])));
  patch.set_member("scenes", scene, "nodes", list.text());
}

bool join_root(Patch& patch, const File& file, const Places& places, const Edits& edits,
               Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  report_left_out(patch, file, diagnostics);
  join_extras(patch, file, diagnostics);
  join_names(patch, file);
  join_rigs(patch, file, places, edits);
  RootExtensions extensions(patch, file, edits, diagnostics);
  for (const auto& [name, content] : file.root()["extensions"].members())
    if (name != "RIGC_rig") extensions.join(name, content);
  return diagnostics.errors() == errors;
}

}  // namespace rigc::gltf
