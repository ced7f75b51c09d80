// SPDX-License-Identifier: MIT
// Elements of top-level arrays: their places in the merged file, and their texts there.
// Test: tests/gltf/merge_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "gltf/merge_codes.h"
#include "gltf/merge_parts.h"
#include "gltf/merge_table.h"
#include "gltf/splice.h"
#include "gltf/uri.h"

namespace rigc::gltf {
namespace {

using json::Value;

/// The clip of the merged file that each clip of the file joins: of clips with one name the n-th
/// joins the n-th.
Joins find_joins(const Patch& patch, const std::vector<Value>& clips) {
  std::map<std::string, std::vector<int>> there;
  for (int i = 0; i < patch.count("animations"); ++i) {
    const json::Document clip = parsed(patch.element("animations", i));
    if (const auto name = clip.root()["name"].string()) there[*name].push_back(i);
  }
  Joins joins;
  std::map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const auto name = clips[i]["name"].string();
    if (!name) continue;
    const std::vector<int>& others = there[*name];
    const std::size_t number = seen[*name]++;
    if (number >= others.size()) continue;
    const json::Document other = parsed(patch.element("animations", others[number]));
    joins.clips[i] = {others[number], other.root()["samplers"].size()};
  }
  return joins;
}

/// Whether a scene says more than what is in it: the merged file's may say otherwise.
bool stands_alone(const Value& scene) { return scene["extensions"] || scene["extras"]; }

/// Where the merged file has no scene yet, the file's become its scenes.
void take_scenes(Patch& patch, const File& file, std::vector<int>& places, Joins& joins) {
  const auto scenes = file.root()["scenes"].items();
  if (scenes.empty()) return;
  const auto mine = static_cast<std::size_t>(file.root()["scene"].integer().value_or(0));
  const int there = default_scene(patch);
  if (there >= 0) joins.scene = static_cast<int>(mine);
  joins.scene_comes = stands_alone(scenes[mine]);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const bool comes = i != mine || there < 0 || joins.scene_comes;
    places.push_back(comes ? patch.append("scenes", "{}") : there);
  }
  if (there < 0) patch.set_root_member("scene", std::to_string(places[mine]));
}

/// Places of what the root's extensions hold behind what the merged file's have.
void take_united(const Patch& patch, const File& file, Places& places) {
  for (const auto& [name, content] : file.root()["extensions"].members()) {
    for (const std::string_view array : united_arrays(name)) {
      const json::Document document = parsed(patch.root_extension(name));
      const auto before = static_cast<int>(document.root()[array].size());
      std::vector<int>& list = places.arrays[name + "." + std::string(array)];
      for (std::size_t i = 0; i < content[array].size(); ++i)
        list.push_back(before + static_cast<int>(i));
    }
  }
}

/// The clip with the samplers and channels of another behind its own. What the other says besides,
/// and this one otherwise, is left out.
std::string joined_clip(const std::string& text, const File& file, const Value& clip,
                        const Edits& edits, Diagnostics& diagnostics) {
  const json::Document document = parsed(text);
  Splice whole(document.root());
  for (const auto& [name, value] : clip.members()) {
    if (name == "samplers" || name == "channels") continue;
    const Value there = document.root()[name];
    if (!there)
      whole.set(name, edits.text(value));
    else if (there.text() != edits.text(value))
      diagnostics.report(codes::kMergeLeftOut, Place(file.path, value.pointer()),
                         fmt::format("\"{}\" of the clip does not come into the merged file",
                                     printable(name, 60)));
  }
  for (const char* list : {"samplers", "channels"}) {
    if (!document.root()[list].is_array()) {
      whole.set(list, edits.text(clip[list]));
      continue;
    }
    Splice items(document.root()[list]);
    for (const Value& item : clip[list].items()) items.append(edits.text(item));
    whole.set(list, items.text());
  }
  return whole.text();
}

}  // namespace

int default_scene(const Patch& patch) {
  if (patch.count("scenes") == 0) return -1;
  return static_cast<int>(parse_integer(patch.root_member("scene")).value_or(0));
}

Joins take_places(Patch& patch, const File& file, const MergeOptions& options, Places& places) {
  Joins joins;
  if (options.join_clips) joins = find_joins(patch, file.root()["animations"].items());
  for (const std::string_view array : kTopLevel) {
    std::vector<int>& list = places.arrays[std::string(array)];
    const std::size_t size = file.root()[array].size();
    if (array == "scenes") {
      take_scenes(patch, file, list, joins);
      continue;
    }
    for (std::size_t i = 0; i < size; ++i) {
      const auto join = array == "animations" ? joins.clips.find(i) : joins.clips.end();
      if (join != joins.clips.end())
        list.push_back(join->second.to);
      else if (array == "buffers" && is_taken_in(file, i, options))
        list.push_back(-1);
      else
        list.push_back(patch.append(array, "{}"));
    }
  }
  take_united(patch, file, places);
  return joins;
}

void shift_samplers(const File& file, const Joins& joins, Edits& edits) {
  const auto clips = file.root()["animations"].items();
  for (const auto& [index, join] : joins.clips)
    for (const Value& channel : clips[index]["channels"].items())
      if (const auto sampler = channel["sampler"].integer())
        edits.replace(channel["sampler"],
                      std::to_string(*sampler + static_cast<std::int64_t>(join.samplers)));
}

void write_elements(Patch& patch, const File& file, const Places& places, const Joins& joins,
                    const Edits& edits, Diagnostics& diagnostics) {
  for (const std::string_view array : kTopLevel) {
    if (array == "bufferViews") continue;
    const auto elements = file.root()[array].items();
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const int place = places.find(array, static_cast<std::int64_t>(i));
      if (place < 0) continue;
      const bool joins_clip = array == "animations" && joins.clips.count(i) != 0;
      if (joins_clip)
        patch.replace(
            array, place,
            joined_clip(patch.element(array, place), file, elements[i], edits, diagnostics));
      else if (array != "scenes" || static_cast<int>(i) != joins.scene || joins.scene_comes)
        patch.replace(array, place, edits.text(elements[i]));
    }
  }
}

std::vector<std::string> referenced_files(const File& file, const MergeOptions& options) {
  std::vector<std::string> names;
  std::set<std::string> known;
  for (const char* array : {"buffers", "images"}) {
    const auto elements = file.root()[array].items();
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (std::string_view(array) == "buffers" && is_taken_in(file, i, options)) continue;
      const auto uri = elements[i]["uri"].string();
      if (!uri || is_data_uri(*uri) || is_absolute_uri(*uri)) continue;
      const auto name = percent_decoded(*uri);
      if (name && known.insert(*name).second) names.push_back(*name);
    }
  }
  return names;
}

}  // namespace rigc::gltf
