// SPDX-License-Identifier: MIT
// Appends files to the first of them. Test: tests/gltf/merge_test.cpp
#include "gltf/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "gltf/merge_codes.h"
#include "gltf/merge_parts.h"
#include "gltf/merge_places.h"
#include "gltf/merge_table.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"

namespace rigc::gltf {
namespace {

using json::Value;

/// A file with its rigs.
struct Source {
  const File& file;
  std::vector<Rig> rigs;
};

std::optional<std::vector<Source>> read_sources(const std::deque<File>& files,
                                                Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  std::vector<Source> sources;
  for (const File& file : files) {
    if (!sources.empty()) check_extensions(file, diagnostics);
    auto rigs = read_rigs(file, diagnostics);
    sources.push_back({file, rigs ? *std::move(rigs) : std::vector<Rig>()});
  }
  if (diagnostics.errors() != errors) return std::nullopt;
  return sources;
}

/// Rigs are told apart by their global groups, and there is an end to how many can be read again.
bool check_rigs(const std::vector<Source>& sources, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  std::map<std::string, const File*> globals;
  std::size_t rigs = 0, nodes = 0;
  for (const Source& source : sources) {
    for (const Rig& rig : source.rigs) {
      ++rigs;
      nodes += rig.scene.size();
      const auto [other, is_new] = globals.emplace(rig.skeleton.global, &source.file);
      if (is_new || other->second == &source.file) continue;
      const std::string global = printable(rig.skeleton.global, 60);
      diagnostics.report(
          codes::kMergeSameGlobal, Place(source.file.path, "/extensions/RIGC_rig"),
          fmt::format("{} and {} both have a rig \"{}\"", printable(other->second->path),
                      printable(source.file.path), global),
          fmt::format("rigc rename {} --global {}=OTHER", printable(source.file.path), global));
    }
  }
  if (rigs > kMostRigs || nodes > kMostNodes)
    diagnostics.report(codes::kRigTooLarge, Place(sources.front().file.path),
                       fmt::format("together the files have {} rigs with {} nodes", rigs, nodes));
  return diagnostics.errors() == errors;
}

/// Keeps the ids that no file before has; others get the least that is free.
class Ids {
 public:
  void take(const std::vector<std::uint32_t>& ids, Places& places) {
    std::vector<std::uint32_t> clashing;
    for (const std::uint32_t id : ids) {
      if (!taken_.insert(id).second)
        clashing.push_back(id);
      else
        places.rigs[id] = id;
    }
    for (const std::uint32_t id : clashing) {
      while (!taken_.insert(next_).second) ++next_;
      places.rigs[id] = next_;
    }
  }

 private:
  std::set<std::uint32_t> taken_;
  std::uint32_t next_ = 0;
};

std::size_t rig_count(const std::vector<Source>& sources) {
  std::size_t count = 0;
  for (const Source& source : sources) count += source.rigs.size();
  return count;
}

}  // namespace

std::optional<Merged> merge(Patch& patch, const std::deque<File>& files,
                            const MergeOptions& options, Diagnostics& diagnostics) {
  const auto sources = read_sources(files, diagnostics);
  if (!sources || !check_rigs(*sources, diagnostics)) return std::nullopt;

  Merged merged;
  Ids ids;
  Places first;
  ids.take(rig_ids(files.front(), sources->front().rigs), first);
  merged.copies.resize(1);
  for (std::size_t i = 1; i < files.size(); ++i) {
    const Source& source = (*sources)[i];
    Places places;
    ids.take(rig_ids(source.file, source.rigs), places);
    const Joins joins = take_places(patch, source.file, options, places);
    Edits edits;
    if (!remap(source.file, places, edits, diagnostics)) return std::nullopt;
    remap_rigs(source.file, source.rigs, places, edits);
    shift_samplers(source.file, joins, edits);
    edits.sort();
    write_elements(patch, source.file, places, joins, edits, diagnostics);
    write_views(patch, source.file, places, options);
    join_scenes(patch, source.file, places, joins);
    if (!join_root(patch, source.file, places, edits, diagnostics)) return std::nullopt;
    merged.copies.push_back(referenced_files(source.file, options));
  }
  merged.rigs = rig_count(*sources);
  merged.nodes = static_cast<std::size_t>(patch.count("nodes"));
  merged.meshes = static_cast<std::size_t>(patch.count("meshes"));
  merged.clips = static_cast<std::size_t>(patch.count("animations"));
  return merged;
}

}  // namespace rigc::gltf
