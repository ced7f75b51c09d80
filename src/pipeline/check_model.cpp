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
  std::size_t matched = 0;
  std::vector<std::string> missing;
  bool better_than(const Candidate& other) const {
    if (missing.empty() != other.missing.empty()) return missing.empty();
    return matched > other.matched;
  }
};

/// Templates and maps to try; what is wrong with them is reported where they are checked.
class Trials {
 public:
  explicit Trials(const Paths& paths);
  std::optional<Candidate> best(const tags::ForeignSkeleton& skeleton) const;

 private:
  struct Tried {
    std::string path;
    templates::Expanded expanded;
  };
  std::vector<Tried> templates_;
  std::vector<templates::Map> maps_;
};

/// A template for fitting; a part that needs an outer template is none.
std::optional<templates::Expanded> expanded(const std::string& path, templates::Library& library,
                                            const catalog::Catalogue& catalogue,
                                            Diagnostics& diagnostics) {
  const templates::Template* main = library.open(path, diagnostics);
  if (!main || !main->needs.empty()) return std::nullopt;
  return templates::expand(*main, library, catalogue, diagnostics);
}

Trials::Trials(const Paths& paths) {
  Diagnostics ignored;
  catalog::Catalogue catalogue;
  add_modules(paths, catalogue, ignored);
  templates::Library library(templates::template_folders(paths.templates), catalogue);
  maps_ = templates::all_maps(library.folders(), ignored);
  for (const std::string& folder : library.folders())
    for (const std::string& file : list_folder(folder)) {
      if (!ends_with(file, ".yaml")) continue;
      const std::string path = join_path(folder, file);
      if (auto tried = expanded(path, library, catalogue, ignored))
        templates_.push_back({path, std::move(*tried)});
    }
}

std::optional<Candidate> Trials::best(const tags::ForeignSkeleton& skeleton) const {
  std::optional<Candidate> best;
  for (const Tried& tried : templates_) {
    const auto trials = templates::try_maps(maps_, tried.expanded, skeleton);
    if (trials.empty() || trials.front().matched.empty()) continue;
    const MapTrial& trial = trials.front();
    Candidate candidate{tried.path, stem_of(tried.path), trial.map->name, trial.matched.size(),
                        trial.missing};
    if (!best || candidate.better_than(*best)) best = std::move(candidate);
  }
  return best;
}

/// Fits for its warnings.
void fit(const tags::ForeignSkeleton& skeleton, const Candidate& best, const Paths& paths,
         Diagnostics& diagnostics) {
  catalog::Catalogue catalogue;
  if (!add_modules(paths, catalogue, diagnostics)) return;
  templates::Library library(templates::template_folders(paths.templates), catalogue);
  const auto main = expanded(best.path, library, catalogue, diagnostics);
  const auto map = templates::find_map(best.map, library.folders(), diagnostics);
  templates::FitReport report;
  if (main && map) templates::fit(*main, skeleton, *map, report, diagnostics);
}

void check_skeleton(const gltf::File& file, const tags::ForeignSkeleton& skeleton,
                    const std::optional<Candidate>& best, const Paths& paths, CheckedFile& out,
                    Diagnostics& diagnostics) {
  const tags::ForeignJoint& first = skeleton.joints.front();
  const std::string what = fmt::format("skeleton {} \"{}\", {} joints", first.node,
                                       printable(first.name, 60), skeleton.joints.size());
  if (best && best->missing.empty()) {
    out.facts.push_back(fmt::format("{}: {} fits with map \"{}\", {} joints matched", what,
                                    best->name, best->map, best->matched));
    return fit(skeleton, *best, paths, diagnostics);
  }
  out.facts.push_back(what);
  diagnostics.report(
      codes::kNothingFits, Place(file.path, fmt::format("/nodes/{}", first.node)),
      best ? fmt::format("no template fits: nearest is {} with map \"{}\", which misses {}",
                         best->name, best->map, printable(join(best->missing, ", "), 200))
           : "no map knows the bones of this skeleton",
      fmt::format("`rigc map {} -o map.yaml` writes a first guess for `rigc build --map map.yaml`",
                  printable(file.path)));
}

}  // namespace

void check_model(const gltf::File& file, const CheckRequest& request, CheckedFile& out,
                 Diagnostics& diagnostics) {
  const auto skeletons = gltf::read_skeletons(file, "bind", diagnostics);
  if (!skeletons) return;
  if (skeletons->empty()) {
    out.facts.push_back("no skeleton: nothing to rig");
    return;
  }
  const Trials trials(request.paths);
  for (const tags::ForeignSkeleton& skeleton : *skeletons)
    check_skeleton(file, skeleton, trials.best(skeleton), request.paths, out, diagnostics);
}

}  // namespace rigc::pipeline
