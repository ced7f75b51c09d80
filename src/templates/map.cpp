// SPDX-License-Identifier: MIT
// Maps: where they lie, and what a user's own map gets told. Test: tests/templates/map_test.cpp
#include "templates/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/files.h"
#include "base/text.h"
#include "templates/codes.h"

namespace rigc::templates {
namespace {

constexpr std::uint64_t kMostBytes = 1u << 20;

std::string map_path(const std::string& folder, const std::string& name) {
  return join_path(join_path(folder, "maps"), name + ".yaml");
}

std::optional<Map> read_map_file(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_file(path, kMostBytes, diagnostics);
  if (!text) return std::nullopt;
  return read_map(diagnostics.sources().add(path, std::move(*text)), diagnostics);
}

/// Names and paths, by name.
std::vector<std::pair<std::string, std::string>> map_files(
    const std::vector<std::string>& template_folders) {
  std::vector<std::pair<std::string, std::string>> maps;
  std::set<std::string> names;
  for (const std::string& folder : template_folders)
    for (const std::string& file : list_folder(join_path(folder, "maps")))
      if (ends_with(file, ".yaml") && names.insert(stem_of(file)).second)
        maps.emplace_back(stem_of(file), map_path(folder, stem_of(file)));
  std::sort(maps.begin(), maps.end());
  return maps;
}

}  // namespace

const MapEntry* Map::find(std::string_view local, std::string_view label) const {
  for (const MapEntry& entry : entries)
    if (entry.local == local && entry.label == label) return &entry;
  return nullptr;
}

std::optional<Map> find_map(const std::string& name_or_path,
                            const std::vector<std::string>& template_folders,
                            Diagnostics& diagnostics) {
  const bool is_path =
      name_or_path.find('/') != std::string::npos || ends_with(name_or_path, ".yaml");
  if (is_path) return read_map_file(name_or_path, diagnostics);
  std::vector<std::string> names;
  for (const auto& [name, path] : map_files(template_folders)) {
    if (name == name_or_path) return read_map_file(path, diagnostics);
    names.push_back(name);
  }
  diagnostics.report(codes::kUnknownMap, Place(),
                     fmt::format("there is no map \"{}\"", printable(name_or_path, 100)),
                     suggest(name_or_path, names));
  return std::nullopt;
}

std::vector<Map> all_maps(const std::vector<std::string>& template_folders,
                          Diagnostics& diagnostics) {
  std::vector<Map> maps;
  for (const auto& [name, path] : map_files(template_folders))
    if (auto map = read_map_file(path, diagnostics)) maps.push_back(*std::move(map));
  return maps;
}

void check_map(const Map& map, const Expanded& expanded, const tags::ForeignSkeleton& skeleton,
               Diagnostics& diagnostics) {
  std::vector<std::string> joints;
  for (const ExpandedJoint& joint : expanded.joints) {
    const Identifiers& ids = joint.tagged.ids;
    joints.push_back(ids.label.empty() ? ids.local : ids.local + "." + ids.label);
  }
  const BoneNames names(map, skeleton);
  const std::vector<std::string> known = names.names();
  for (const MapEntry& entry : map.entries) {
    const std::string key = entry.label.empty() ? entry.local : entry.local + "." + entry.label;
    if (std::find(joints.begin(), joints.end(), key) == joints.end())
      diagnostics.report(codes::kMapEntryIdle, entry.span,
                         fmt::format("the template has no joint {}", printable(key, 60)),
                         suggest(key, joints));
    for (const std::vector<std::string>& one_of : entry.bones) {
      const bool found = std::any_of(one_of.begin(), one_of.end(), [&](const std::string& bone) {
        return names.find(bone) >= 0;
      });
      if (!found && !one_of.empty())
        diagnostics.report(
            codes::kMapBoneAbsent, entry.span,
            fmt::format("the model has no bone {}", printable(join(one_of, ", "), 200)),
            suggest(one_of.front(), known));
    }
  }
}

}  // namespace rigc::templates
