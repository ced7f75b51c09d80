// SPDX-License-Identifier: MIT
// Check of a model without a rig: which template and map fit its skeletons, and what the fit warns
// of. Test: tests/pipeline/check_test.cpp
#include <fmt/format.h>

#include "base/files.h"
#include "base/text.h"
#include "gltf/skeletons.h"
#include "pipeline/check_kinds.h"
#include "pipeline/codes.h"
#include "templates/fit.h"
#include "templates/library.h"

namespace rigc::pipeline {
namespace {

using templates::MapTrial;

/// A template with its best map.
struct Candidate {
  std::string path, name, map;
  std::size_t matched = 0, required = 0;
  std::vector<std::string> missing;
  bool better_than(const Candidate& other) const {
    if (missing.empty() != other.missing.empty()) return missing.empty();
    return matched > other.matched;
  }
};

/// Reads and expands templates for fitting; what is wrong with them is `rigc check TEMPLATE`'s.
class Templates {
 public:
  Templates(const Paths& paths, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        good_(add_modules(paths, catalogue_, diagnostics)),
        library_(templates::template_folders(paths.templates), catalogue_) {}

  std::optional<templates::Expanded> expanded(const std::string& path) {
    const templates::Template* main = good_ ? library_.open(path, diagnostics_) : nullptr;
    if (!main || !main->needs.empty()) return std::nullopt;
    return templates::expand(*main, library_, catalogue_, diagnostics_);
  }
  const std::vector<std::string>& folders() const { return library_.folders(); }
  std::vector<std::string> paths() const;

 private:
  Diagnostics& diagnostics_;
  catalog::Catalogue catalogue_;
  bool good_;
  templates::Library library_;
};

std::vector<std::string> Templates::paths() const {
  std::vector<std::string> found;
  for (const std::string& folder : folders())
    for (const std::string& file : list_folder(folder))
      if (ends_with(file, ".yaml")) found.push_back(join_path(folder, file));
  return found;
}

std::optional<Candidate> best_candidate(const tags::ForeignSkeleton& skeleton, const Paths& paths) {
  Diagnostics ignored;
  Templates all(paths, ignored);
  const auto maps = templates::all_maps(all.folders(), ignored);
  std::optional<Candidate> best;
  for (const std::string& path : all.paths()) {
    const auto expanded = all.expanded(path);
    if (!expanded) continue;
    const auto trials = templates::try_maps(maps, *expanded, skeleton);
    if (trials.empty() || trials.front().matched.empty()) continue;
    const MapTrial& trial = trials.front();
    Candidate candidate{path,           stem_of(path), trial.map->name, trial.matched.size(),
                        trial.required, trial.missing};
    if (!best || candidate.better_than(*best)) best = std::move(candidate);
  }
  return best;
}

void check_skeleton(const gltf::File& file, const tags::ForeignSkeleton& skeleton,
                    const CheckRequest& request, CheckedFile& out, Diagnostics& diagnostics) {
  const tags::ForeignJoint& first = skeleton.joints.front();
  const std::string what = fmt::format("skeleton {} \"{}\", {} joints", first.node,
                                       printable(first.name, 60), skeleton.joints.size());
  const auto best = best_candidate(skeleton, request.paths);
  if (!best || !best->missing.empty()) {
    out.facts.push_back(what);
    diagnostics.report(
        codes::kNothingFits, Place(file.path, fmt::format("/nodes/{}", first.node)),
        best ? fmt::format("no template fits: nearest is {} with map \"{}\", which misses {}",
                           best->name, best->map, printable(join(best->missing, ", "), 200))
             : "no map knows the bones of this skeleton",
        "`rigc map MODEL -o map.yaml` writes a first guess for `rigc build --map map.yaml`");
    return;
  }
  out.facts.push_back(fmt::format("{}: {} fits with map \"{}\", {} joints matched", what,
                                  best->name, best->map, best->matched));
  Templates again(request.paths, diagnostics);
  const auto expanded = again.expanded(best->path);
  const auto map = templates::find_map(best->map, again.folders(), diagnostics);
  templates::FitReport report;
  if (expanded && map) templates::fit(*expanded, skeleton, *map, report, diagnostics);
}

}  // namespace

void check_model(const gltf::File& file, const CheckRequest& request, CheckedFile& out,
                 Diagnostics& diagnostics) {
  const auto skeletons = gltf::read_skeletons(file, "bind", diagnostics);
  if (!skeletons) return;
  if (skeletons->empty()) out.facts.push_back("no skeleton: nothing to rig");
  for (const tags::ForeignSkeleton& skeleton : *skeletons)
    check_skeleton(file, skeleton, request, out, diagnostics);
}

}  // namespace rigc::pipeline
