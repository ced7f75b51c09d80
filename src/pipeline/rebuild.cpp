// SPDX-License-Identifier: MIT
// Rebuild, unbuild, strip and prune. Test: tests/pipeline/rebuild_test.cpp
#include "pipeline/rebuild.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "base/text.h"
#include "pipeline/guides.h"
#include "pipeline/merge_codes.h"
#include "pipeline/place_again.h"
#include "pipeline/update_codes.h"
#include "tags/settings.h"
#include "templates/arguments.h"

namespace rigc::pipeline {
namespace {

/// Indices of the rigs that somebody named, all where nobody did; a name that no rig has is
/// reported.
std::optional<std::vector<std::size_t>> choose(const std::vector<gltf::Rig>& rigs,
                                               const std::vector<std::string>& wanted,
                                               const std::string& path, Diagnostics& diagnostics) {
  std::vector<std::size_t> out;
  std::vector<std::string> names;
  for (const gltf::Rig& rig : rigs) names.push_back(rig.skeleton.global);
  for (const std::string& name : wanted) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    diagnostics.report(codes::kNoSuchRig, Place(path),
                       fmt::format("the file has no rig \"{}\"", printable(name, 60)),
                       "its rigs: " + printable(join(names, ", "), 200));
    return std::nullopt;
  }
  for (std::size_t i = 0; i < rigs.size(); ++i) {
    const bool named = std::find(wanted.begin(), wanted.end(), names[i]) != wanted.end();
    if (wanted.empty() || named) out.push_back(i);
  }
  return out;
}

/// What the file was built with, and over it what the request says.
bool add_settings(const RebuildRequest& request, tags::Settings& settings,
                  Diagnostics& diagnostics) {
  bool good = true;
  for (const std::string& text : request.features) {
    const auto feature = tags::parse_feature_setting(text, diagnostics);
    good = good && feature;
    if (!feature) continue;
    std::erase_if(settings.features, [&](const tags::Settings::Feature& other) {
      return other.group == feature->group && other.name == feature->name &&
             other.switch_name == feature->switch_name;
    });
    settings.features.push_back(*feature);
  }
  for (const std::string& text : request.groups) {
    const auto group = tags::parse_group_setting(text, diagnostics);
    good = good && group;
    if (!group) continue;
    std::erase_if(settings.groups, [&](const auto& other) { return other.first == group->first; });
    settings.groups.push_back(*group);
  }
  if (!request.split_weights.empty()) {
    const auto on = tags::parse_switch("--split-weights", request.split_weights, diagnostics);
    good = good && on;
    settings.split_weights = on.value_or(false);
  }
  return good;
}

/// Commands as the modules take them now. Reported: what they no longer take.
bool upgrade_tags(const std::vector<std::pair<std::string, int>>& versions,
                  const catalog::Catalogue& catalogue, tags::TaggedSkeleton& skeleton,
                  Diagnostics& diagnostics) {
  const std::map<std::string, int> by_module(versions.begin(), versions.end());
  bool good = true;
  for (tags::TaggedJoint& joint : skeleton.joints) {
    for (tags::CommandTag& command : joint.commands) {
      const auto version = by_module.find(command.module);
      const catalog::Descriptor* descriptor = catalogue.find(command.module);
      if (version == by_module.end() || !descriptor || version->second == descriptor->version)
        continue;
      good = templates::upgrade(*descriptor, version->second, command, diagnostics) && good;
    }
  }
  return good;
}

/// Writes what a work made of a file.
bool write_work(gltf::Patch& patch, const gltf::File& file, const FileWork& work,
                std::uint64_t& bytes, Diagnostics& diagnostics) {
  return keep_original(work, file.whole, diagnostics) &&
         write_output(patch, file, work.output, bytes, diagnostics);
}

/// A file with at least one rig, and which of its rigs are meant. Locked where it is replaced.
struct Opened {
  std::optional<FileLock> lock;
  gltf::File file;
  std::vector<gltf::Rig> rigs;
  std::vector<std::size_t> chosen;
};

/// Whether the guides are of any of the chosen rigs.
bool check_guides(const templates::Guides& guides, const std::vector<gltf::Rig>& rigs,
                  const std::vector<std::size_t>& chosen, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const std::size_t index : chosen) names.push_back(rigs[index].skeleton.name);
  return check_guides_of(guides, names, diagnostics);
}

std::optional<Opened> open_rigs(const FileWork& work, const std::vector<std::string>& wanted,
                                Diagnostics& diagnostics) {
  std::optional<FileLock> lock;
  if (!lock_input(work, lock, diagnostics)) return std::nullopt;
  auto file = gltf::open(work.input, diagnostics);
  if (!file) return std::nullopt;
  auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return std::nullopt;
  if (rigs->empty()) {
    diagnostics.report(codes::kNoRigHere, Place(work.input), "the file has no rig");
    return std::nullopt;
  }
  auto chosen = choose(*rigs, wanted, work.input, diagnostics);
  if (!chosen) return std::nullopt;
  return Opened{std::move(lock), *std::move(file), *std::move(rigs), *std::move(chosen)};
}

}  // namespace

std::optional<Rebuilt> rebuild(const RebuildRequest& request, const catalog::Catalogue& catalogue,
                               const FileWork& work, Diagnostics& diagnostics) {
  std::optional<FileLock> lock;
  if (!request.plan && !lock_input(work, lock, diagnostics)) return std::nullopt;
  const auto file = Recompilation::open(work.input, diagnostics);
  if (!file) return std::nullopt;
  const auto chosen = choose(file->rigs(), request.rigs, work.input, diagnostics);
  if (!chosen) return std::nullopt;
  std::optional<templates::Guides> guides;
  if (!request.guides.empty()) {
    guides = templates::open_guides(request.guides, catalogue, diagnostics);
    if (!guides || !check_guides(*guides, file->rigs(), *chosen, diagnostics)) return std::nullopt;
  }
  Rebuilt out;
  for (const std::size_t index : *chosen) {
    const gltf::Rig& old = file->rigs()[index];
    NewRig next;
    next.skeleton = old.skeleton;
    if (!upgrade_tags(old.modules, catalogue, next.skeleton, diagnostics)) return std::nullopt;
    RigReport& report = out.rigs.emplace_back();
    if (guides && guides->template_name == old.skeleton.name &&
        !apply_guides(*guides, nullptr, catalogue, next.skeleton, report.put_back, diagnostics))
      return std::nullopt;
    next.settings = old.settings;
    next.skeleton_only = request.unbuild;
    if (!add_settings(request, next.settings, diagnostics)) return std::nullopt;
    if (!old.skeleton.templates.empty()) {
      const tags::TemplateReference& main = old.skeleton.templates.front();
      report.template_name = report.template_before = main.name;
      report.version = report.version_before = main.version;
    }
    report.why = request.unbuild ? "taken apart" : "built again";
    if (!file->compile(index, std::move(next), catalogue, request, report, diagnostics))
      return std::nullopt;
  }
  if (!request.plan && !file->write(work, out.bytes, diagnostics)) return std::nullopt;
  return out;
}

std::optional<Removed> strip(const std::vector<std::string>& rigs, const FileWork& work,
                             Diagnostics& diagnostics) {
  const auto opened = open_rigs(work, rigs, diagnostics);
  if (!opened) return std::nullopt;
  Removed out;
  std::vector<gltf::Rig> models, characters;
  for (const std::size_t index : opened->chosen) {
    const gltf::Rig& rig = opened->rigs[index];
    out.rigs.push_back(rig.skeleton.global);
    out.orphans += rig.orphans.size();
    (is_fitted(rig.skeleton) ? models : characters).push_back(rig);
  }
  gltf::Patch patch(opened->file);
  std::set<int> gone;
  for (const auto& [group, remains] :
       {std::pair(&models, gltf::Strip::nothing), std::pair(&characters, gltf::Strip::character)})
    if (!group->empty()) gone.merge(gltf::strip_rigs(patch, opened->file, *group, remains));
  out.channels = gltf::drop_channels(patch, opened->file, gone);
  if (!write_work(patch, opened->file, work, out.bytes, diagnostics)) return std::nullopt;
  return out;
}

std::optional<Removed> prune(const std::vector<std::string>& rigs, const FileWork& work,
                             Diagnostics& diagnostics) {
  const auto opened = open_rigs(work, rigs, diagnostics);
  if (!opened) return std::nullopt;
  Removed out;
  std::vector<gltf::Rig> pruned;
  std::vector<gltf::Replacement> replacements;
  std::set<int> gone;
  pruned.reserve(opened->chosen.size());
  for (const std::size_t index : opened->chosen) {
    const gltf::Rig& rig = opened->rigs[index];
    out.rigs.push_back(rig.skeleton.global);
    out.orphans += rig.orphans.size();
    if (rig.orphans.empty()) continue;
    for (const gltf::Orphan& orphan : rig.orphans) gone.insert(orphan.node);
    gltf::Rig& next = pruned.emplace_back(rig);
    next.orphans.clear();
    replacements.push_back({&rig, &next, gltf::own_nodes(rig), diagnostics.sources()});
  }
  if (replacements.empty()) {
    if (!pass_on(work, out.bytes, diagnostics)) return std::nullopt;
    return out;
  }
  gltf::Patch patch(opened->file);
  if (!gltf::replace_rigs(patch, opened->file, replacements, diagnostics)) return std::nullopt;
  out.channels = gltf::drop_channels(patch, opened->file, gone);
  if (!write_work(patch, opened->file, work, out.bytes, diagnostics)) return std::nullopt;
  return out;
}

}  // namespace rigc::pipeline
