// SPDX-License-Identifier: MIT
// Maps: reading, finding, detecting, and the comparison of bone names. Test:
// tests/templates/map_test.cpp
#include "templates/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/files.h"
#include "base/text.h"
#include "base/yaml.h"
#include "templates/codes.h"

namespace rigc::templates {
namespace {

constexpr std::uint64_t kMostBytes = 1u << 20;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string folded(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// How many characters at the begin of `text` the pattern stands for; nothing if it does not fit
/// there.
std::optional<std::size_t> fits_begin(std::string_view text, std::string_view pattern) {
  std::size_t at = 0;
  for (const char c : pattern) {
    if (c == '#') {
      while (at < text.size() && is_digit(text[at])) ++at;
    } else {
      if (at >= text.size() || text[at] != c) return std::nullopt;
      ++at;
    }
  }
  return at;
}

std::string reversed(std::string_view text) { return {text.rbegin(), text.rend()}; }

/// A bone's name without the first prefix and the first suffix that fit; never empty.
std::string stripped(const Map& map, const std::string& name) {
  std::string out = name;
  for (const std::string& prefix : map.prefixes) {
    const auto length = fits_begin(folded(out), folded(prefix));
    if (!length || *length >= out.size()) continue;
    out.erase(0, *length);
    break;
  }
  for (const std::string& suffix : map.suffixes) {
    const auto length = fits_begin(folded(reversed(out)), folded(reversed(suffix)));
    if (!length || *length >= out.size()) continue;
    out.resize(out.size() - *length);
    break;
  }
  return out;
}

std::vector<std::string> read_texts(const yaml::Node& node, std::string_view what,
                                    Diagnostics& diagnostics) {
  std::vector<std::string> texts;
  const auto add = [&](const yaml::Node& item) {
    const auto text = yaml::as_text(item, what, diagnostics);
    if (text && !text->empty()) texts.push_back(*text);
  };
  if (node.is_sequence())
    for (const yaml::Node& item : node.items) add(item);
  else
    add(node);
  return texts;
}

void read_entry(const yaml::Node::Entry& entry, Map& map, Diagnostics& diagnostics) {
  MapEntry read;
  read.span = entry.key_span;
  const std::size_t dot = entry.key.find('.');
  read.local = entry.key.substr(0, dot);
  if (dot != std::string::npos) read.label = entry.key.substr(dot + 1);
  const bool named = is_name(read.local) && (dot == std::string::npos || is_name(read.label));
  if (!named) {
    diagnostics.report(
        codes::kBadMapEntry, entry.key_span,
        fmt::format("\"{}\" is neither GROUP.LABEL nor GROUP", printable(entry.key, 60)));
    return;
  }
  if (read.label.empty() && entry.value.is_sequence()) {
    for (const yaml::Node& item : entry.value.items)
      read.bones.push_back(read_texts(item, entry.key, diagnostics));
  } else {
    read.bones.push_back(read_texts(entry.value, entry.key, diagnostics));
  }
  map.entries.push_back(std::move(read));
}

void read_joints(const yaml::Node& node, Map& map, Diagnostics& diagnostics) {
  if (!node.is_map()) {
    diagnostics.report(codes::kBadMapEntry, node.span, "`joints` is a map",
                       "write `group.label: Bone`");
    return;
  }
  for (const yaml::Node::Entry& entry : node.entries) read_entry(entry, map, diagnostics);
}

std::string map_path(const std::string& folder, const std::string& name) {
  return join_path(join_path(folder, "maps"), name + ".yaml");
}

std::optional<Map> read_map_file(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_file(path, kMostBytes, diagnostics);
  if (!text) return std::nullopt;
  return read_map(diagnostics.sources().add(path, std::move(*text)), diagnostics);
}

/// Names and paths of all maps, by name; a folder hides maps of those after it.
std::vector<std::pair<std::string, std::string>> all_maps(const std::vector<std::string>& folders) {
  std::vector<std::pair<std::string, std::string>> maps;
  std::set<std::string> names;
  for (const std::string& folder : folders)
    for (const std::string& file : list_folder(join_path(folder, "maps")))
      if (ends_with(file, ".yaml") && names.insert(stem_of(file)).second)
        maps.emplace_back(stem_of(file), map_path(folder, stem_of(file)));
  std::sort(maps.begin(), maps.end());
  return maps;
}

std::vector<std::string> names_of(const std::vector<std::pair<std::string, std::string>>& maps) {
  std::vector<std::string> names;
  for (const auto& map : maps) names.push_back(map.first);
  return names;
}

bool has_required(const Map& map, const tags::ForeignSkeleton& skeleton) {
  const auto there = [&](const std::string& pattern) {
    const auto fits = [&](const std::string& name) {
      const auto length = fits_begin(folded(name), folded(pattern));
      return length && *length == name.size();
    };
    if (map.humanoid)
      return std::any_of(skeleton.humanoid.begin(), skeleton.humanoid.end(),
                         [&](const auto& bone) { return fits(bone.first); });
    return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                       [&](const tags::ForeignJoint& joint) { return fits(joint.name); });
  };
  for (const std::vector<std::string>& one_of : map.required)
    if (std::none_of(one_of.begin(), one_of.end(), there)) return false;
  return true;
}

std::size_t count_found(const Map& map, const tags::ForeignSkeleton& skeleton) {
  const BoneNames names(map, skeleton);
  std::size_t count = 0;
  for (const MapEntry& entry : map.entries)
    for (const std::vector<std::string>& one_of : entry.bones)
      for (const std::string& bone : one_of)
        if (names.find(bone) >= 0) {
          ++count;
          break;
        }
  return count;
}

}  // namespace

const MapEntry* Map::find(std::string_view local, std::string_view label) const {
  for (const MapEntry& entry : entries)
    if (entry.local == local && entry.label == label) return &entry;
  return nullptr;
}

std::optional<Map> read_map(std::uint32_t file, Diagnostics& diagnostics) {
  static const std::vector<std::string> kKeys = {"map",      "title",    "names", "prefixes",
                                                 "suffixes", "requires", "joints"};
  const std::size_t errors_before = diagnostics.errors();
  const auto root = yaml::read(file, diagnostics);
  if (!root) return std::nullopt;
  if (!yaml::check_keys(*root, kKeys, "a map", diagnostics) && !root->is_map()) return std::nullopt;
  Map map;
  if (const yaml::Node* name = root->find("map"))
    map.name = yaml::as_name(*name, "map", diagnostics).value_or("");
  else
    diagnostics.report(codes::kMissingKey, root->span, "a map needs `map: NAME`");
  if (const yaml::Node* title = root->find("title"))
    map.title = yaml::as_text(*title, "title", diagnostics).value_or("");
  if (const yaml::Node* names = root->find("names")) {
    const auto text = yaml::as_text(*names, "names", diagnostics);
    map.humanoid = text == "humanoid";
    if (text && *text != "humanoid" && *text != "bones")
      diagnostics.report(codes::kUnknownWord, names->span,
                         fmt::format("names: \"{}\" is not known", printable(*text, 60)),
                         suggest(*text, {"bones", "humanoid"}));
  }
  if (const yaml::Node* prefixes = root->find("prefixes"))
    map.prefixes = read_texts(*prefixes, "prefixes", diagnostics);
  if (const yaml::Node* suffixes = root->find("suffixes"))
    map.suffixes = read_texts(*suffixes, "suffixes", diagnostics);
  if (const yaml::Node* required = root->find("requires"))
    for (const yaml::Node& item : required->items)
      map.required.push_back(read_texts(item, "requires", diagnostics));
  if (const yaml::Node* joints = root->find("joints"))
    read_joints(*joints, map, diagnostics);
  else
    diagnostics.report(codes::kMissingKey, root->span, "a map needs `joints:`");
  if (diagnostics.errors() != errors_before) return std::nullopt;
  return map;
}

std::optional<Map> find_map(const std::string& name_or_path,
                            const std::vector<std::string>& template_folders,
                            Diagnostics& diagnostics) {
  const bool is_path =
      name_or_path.find('/') != std::string::npos || ends_with(name_or_path, ".yaml");
  if (is_path) return read_map_file(name_or_path, diagnostics);
  for (const std::string& folder : template_folders)
    if (file_exists(map_path(folder, name_or_path)))
      return read_map_file(map_path(folder, name_or_path), diagnostics);
  diagnostics.report(codes::kUnknownMap, Place(),
                     fmt::format("there is no map \"{}\"", printable(name_or_path, 100)),
                     suggest(name_or_path, names_of(all_maps(template_folders))));
  return std::nullopt;
}

std::optional<Map> detect_map(const tags::ForeignSkeleton& skeleton,
                              const std::vector<std::string>& template_folders,
                              Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errors();
  const auto maps = all_maps(template_folders);
  std::optional<Map> best;
  std::size_t most = 0;
  for (const auto& [name, path] : maps) {
    auto map = read_map_file(path, diagnostics);
    if (!map || !has_required(*map, skeleton)) continue;
    const std::size_t count = count_found(*map, skeleton);
    if (count <= most) continue;
    most = count;
    best = std::move(map);
  }
  if (diagnostics.errors() != errors_before) return std::nullopt;
  if (!best)
    diagnostics.report(codes::kNoMapFits, Place(), "none of the maps fits the model's skeleton",
                       fmt::format("choose one with --map (there are {}), or write one",
                                   join(names_of(maps), ", ")));
  return best;
}

BoneNames::BoneNames(const Map& map, const tags::ForeignSkeleton& skeleton) {
  if (map.humanoid) {
    for (const auto& [bone, joint] : skeleton.humanoid)
      sorted_.push_back({folded(bone), bone, joint});
  } else {
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
      const std::string name = stripped(map, skeleton.joints[i].name);
      if (!name.empty()) sorted_.push_back({folded(name), name, static_cast<int>(i)});
    }
  }
  const auto rank = [&](const Bone& bone) {
    return skeleton.joints[static_cast<std::size_t>(bone.joint)].in_skin ? 0 : 1;
  };
  std::sort(sorted_.begin(), sorted_.end(), [&](const Bone& a, const Bone& b) {
    if (a.folded != b.folded) return a.folded < b.folded;
    return rank(a) != rank(b) ? rank(a) < rank(b) : a.joint < b.joint;
  });
}

int BoneNames::find(std::string_view bone) const {
  const std::string wanted = folded(bone);
  const auto found = std::lower_bound(
      sorted_.begin(), sorted_.end(), wanted,
      [](const Bone& candidate, const std::string& text) { return candidate.folded < text; });
  return found != sorted_.end() && found->folded == wanted ? found->joint : -1;
}

std::vector<std::string> BoneNames::names() const {
  std::vector<std::string> names;
  for (const Bone& bone : sorted_) names.push_back(bone.name);
  return names;
}

}  // namespace rigc::templates
