// SPDX-License-Identifier: MIT
// Check of glTF files: rigs with their clips, or models without. Test:
// tests/pipeline/check_test.cpp
#include <fmt/format.h>

#include <map>

#include "base/text.h"
#include "pipeline/build.h"
#include "pipeline/check_kinds.h"
#include "pipeline/codes.h"
#include "pipeline/locks.h"
#include "templates/library.h"

namespace rigc::pipeline {
namespace {

std::size_t count_controls(const scene::Scene& scene) {
  std::size_t count = 0;
  for (scene::NodeId id : scene.nodes()) count += scene[id].kind == scene::Kind::control ? 1 : 0;
  return count;
}

/// The version of the template in the template folders; 0 where it is not there.
int version_there(const std::string& name, const CheckRequest& request) {
  Diagnostics ignored;
  catalog::Catalogue catalogue;
  add_modules(request.paths, catalogue, ignored);
  templates::Library library(templates::template_folders(request.paths.templates), catalogue);
  const auto path = library.find(name);
  const templates::Template* found = path ? library.open(*path, ignored) : nullptr;
  return found ? found->version : 0;
}

std::string fact(const gltf::Rig& rig, const CheckRequest& request) {
  std::string text =
      fmt::format("rig {} \"{}\": {} joints, {} controls", rig.id, printable(rig.skeleton.global),
                  rig.skeleton.joints.size(), count_controls(rig.scene));
  if (rig.skeleton.templates.empty()) return text;
  const tags::TemplateReference& main = rig.skeleton.templates.front();
  text += fmt::format(", made by {} version {}", printable(main.name), main.version);
  const int there = version_there(main.name, request);
  if (there > main.version) text += fmt::format("; version {} is there", there);
  return text;
}

}  // namespace

void check_gltf(const CheckRequest& request, CheckedFile& out, Diagnostics& diagnostics) {
  out.kind = "model";
  if (request.pin) {
    diagnostics.report(codes::kCannotPin, Place(out.file), "only templates have pins");
    return;
  }
  const auto file = gltf::open(out.file, diagnostics);
  if (!file) return;
  if (file->root()["extensions"]["RIGC_rig"]) out.kind = "rig";
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!rigs || !clips) return;
  check_identities(*file, *rigs, diagnostics);
  for (const gltf::Rig& rig : *rigs) {
    out.facts.push_back(fact(rig, request));
    if (!check_evaluates(*file, rig, diagnostics)) continue;
    check_clips(out.file, rig, clips->clips, diagnostics);
    for (const anim::Clip& clip : clips->clips)
      report_locked_keys(out.file, rig, clip, diagnostics);
  }
  if (rigs->empty()) check_model(*file, request, out, diagnostics);
  if (!clips->clips.empty())
    out.facts.push_back(
        fmt::format("{} clip{}", clips->clips.size(), clips->clips.size() == 1 ? "" : "s"));
}

void check_identities(const gltf::File& file, const std::vector<gltf::Rig>& rigs,
                      Diagnostics& diagnostics) {
  std::map<std::int64_t, const gltf::Rig*> by_id;
  for (const gltf::Rig& rig : rigs) by_id[rig.id] = &rig;
  const auto nodes = file.root()["nodes"].items();
  for (const json::Value& item : file.root()["extensions"]["RIGC_rig"]["rigs"].items()) {
    const auto found = by_id.find(item["id"].integer().value_or(-1));
    if (found == by_id.end()) continue;
    const gltf::Rig& rig = *found->second;
    std::size_t moved = 0, silent = 0;
    const auto recorded = item["nodes"].items();
    for (std::size_t i = 0; i < recorded.size() && i < rig.nodes.size(); ++i) {
      const int at = rig.nodes[i];
      if (at < 0) continue;
      moved += recorded[i]["node"].integer().value_or(at) != at ? 1 : 0;
      const bool mesh = rig.scene[scene::NodeId{static_cast<std::uint32_t>(i)}].kind ==
                        scene::Kind::mesh;  // found by its index alone
      silent += !mesh && !nodes[static_cast<std::size_t>(at)]["extras"]["rigc"] ? 1 : 0;
    }
    const Place place(file.path, item.pointer());
    if (moved > 0)
      diagnostics.report(
          codes::kNodesMoved, place,
          fmt::format("{} nodes of rig {} have other numbers than RIGC_rig says", moved, rig.id));
    if (silent > 0)
      diagnostics.report(codes::kNoIdentity, place,
                         fmt::format("{} nodes of rig {} do not say what they are", silent, rig.id),
                         "build it again from its template before other programs number the nodes "
                         "anew");
  }
}

}  // namespace rigc::pipeline
