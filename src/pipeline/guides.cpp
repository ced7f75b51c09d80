// SPDX-License-Identifier: MIT
// Guides. Test: tests/pipeline/guides_test.cpp
#include "pipeline/guides.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/vertices.h"
#include "pipeline/codes.h"
#include "templates/codes.h"
#include "update/skeleton.h"

namespace rigc::pipeline {
namespace {

/// A selector of each control of a built rig, and its shape, in the order of the scene.
std::vector<std::pair<std::string, std::string>> controls_of(
    const scene::Scene& scene, const tags::TaggedSkeleton& skeleton,
    const std::vector<std::string>& names) {
  std::map<JointKey, std::string> by_joint;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    by_joint.emplace(skeleton.joints[i].key, names[i]);
  std::map<std::string, int> counts;
  std::vector<std::pair<std::string, std::string>> out;
  for (const scene::NodeId id : scene.nodes()) {
    const scene::Node& node = scene[id];
    if (node.kind != scene::Kind::control || node.ids.local.empty()) continue;
    std::string text = node.ids.label.empty() ? by_joint[node.identity.owner]
                                              : node.ids.local + "." + node.ids.label;
    text += "/" + node.module;
    if (node.identity.command != node.module) text += "#" + node.identity.command;
    text += "." + node.identity.role;
    ++counts[text];
    out.emplace_back(text, std::get<std::string>(node.attributes[scene::control::kShape][0]));
  }
  std::erase_if(out, [&](const auto& entry) { return counts[entry.first] > 1; });
  return out;
}

/// The rig of a file that one of these templates made; a null pointer was reported.
const gltf::Rig* rig_of_template(const std::vector<gltf::Rig>& rigs,
                                 const std::vector<std::string>& names, const std::string& path,
                                 Diagnostics& diagnostics) {
  for (const gltf::Rig& rig : rigs)
    if (std::find(names.begin(), names.end(), rig.skeleton.name) != names.end()) return &rig;
  diagnostics.report(
      codes::kNoRig, Place(path),
      fmt::format("the file has no rig of template {}", printable(names.front(), 60)));
  return nullptr;
}

template <class T, class Same>
void put(std::vector<T>& into, T item, Same same) {
  std::erase_if(into, same);
  into.push_back(std::move(item));
}

/// Adds to guides what was moved and edited in a rig file.
bool take_over(const std::string& path, const Prepared& prepared, templates::Guides& guides,
               Diagnostics& diagnostics) {
  const auto file = gltf::open(path, diagnostics);
  if (!file) return false;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return false;
  const gltf::Rig* rig = rig_of_template(*rigs, prepared.names, path, diagnostics);
  if (!rig) return false;
  const tags::TaggedSkeleton& fresh = prepared.declared;
  const auto names = templates::guide_names(fresh, &*prepared.expanded);
  const std::vector<int> counterparts = update::counterparts(fresh, rig->skeleton);
  for (std::size_t i = 0; i < fresh.joints.size(); ++i) {
    if (counterparts[i] < 0 || fresh.joints[i].foreign_node >= 0) continue;
    const auto other = static_cast<std::size_t>(counterparts[i]);
    templates::Guide guide;
    guide.name = names[i];
    guide.at = templates::to_template(rig->skeleton.character, rig->skeleton.world(other).origin);
    guide.fitted = templates::to_template(fresh.character, fresh.world(i).origin);
    if (guide.moved())
      put(guides.joints, guide, [&](const auto& old) { return old.name == guide.name; });
  }
  for (const templates::ControlEdit& edit : templates::control_edits(rig->skeleton))
    put(guides.controls, edit, [&](const auto& old) { return old.control == edit.control; });
  return true;
}

}  // namespace

bool check_guides_of(const templates::Guides& guides, const std::vector<std::string>& names,
                     Diagnostics& diagnostics) {
  if (std::find(names.begin(), names.end(), guides.template_name) != names.end()) return true;
  diagnostics.report(templates::codes::kOtherGuides, guides.template_span,
                     fmt::format("the guides are of template {}, not of {}",
                                 printable(guides.template_name, 60), printable(names.front(), 60)),
                     "`rigc guides TEMPLATE` writes those of another");
  return false;
}

bool apply_guides(const templates::Guides& guides, const templates::Expanded& expanded, bool fitted,
                  const catalog::Catalogue& catalogue, tags::TaggedSkeleton& skeleton,
                  Diagnostics& diagnostics) {
  const trace::Span span("apply guides");
  const std::size_t errors_before = diagnostics.errors();
  const auto moves = templates::find_moves(guides, &expanded, skeleton,
                                           templates::Fitted::by_skeleton, diagnostics);
  if (moves && fitted) {
    templates::move_joints(skeleton, *moves);
  } else if (moves && !moves->empty()) {
    auto placed = templates::place(expanded, skeleton, *moves, diagnostics);
    if (placed) skeleton = *std::move(placed);
  }
  templates::add_control_edits(guides, catalogue, skeleton, diagnostics);
  return diagnostics.errors() == errors_before;
}

bool apply_guides_again(const templates::Guides& guides, const catalog::Catalogue& catalogue,
                        tags::TaggedSkeleton& skeleton, Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errors();
  const auto moves =
      templates::find_moves(guides, nullptr, skeleton, templates::Fitted::by_guides, diagnostics);
  if (moves) templates::move_joints(skeleton, *moves);
  templates::add_control_edits(guides, catalogue, skeleton, diagnostics);
  return diagnostics.errors() == errors_before;
}

std::optional<GuidesFile> write_guides(const GuidesRequest& request, Diagnostics& diagnostics) {
  const auto prepared = prepare(request.build, diagnostics);
  if (!prepared) return std::nullopt;
  std::optional<templates::Guides> old;
  if (!request.before.empty()) {
    old = templates::open_guides(request.before, prepared->catalogue, diagnostics);
    if (!old || !check_guides_of(*old, prepared->names, diagnostics)) return std::nullopt;
  }
  if (!request.from.empty()) {
    if (!old) old.emplace();
    if (!take_over(request.from, *prepared, *old, diagnostics)) return std::nullopt;
  }
  std::size_t skipped = 0;
  const auto geometry = prepared->model ? gltf::geometry_of(*prepared->model) : tags::Geometry{};
  const auto rig = run_commands(*prepared, prepared->catalogue, geometry, skipped, diagnostics);
  if (!rig) return std::nullopt;
  const tags::TaggedSkeleton& skeleton = prepared->declared;
  const auto names = templates::guide_names(skeleton, &*prepared->expanded);
  GuidesFile out;
  out.template_name = skeleton.name;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    (skeleton.joints[i].foreign_node >= 0 ? out.of_model : out.joints) += 1;
  }
  if (old) {
    out.edited = old->controls.size();
    for (const templates::Guide& guide : old->joints) out.moved += guide.moved() ? 1 : 0;
  }
  out.yaml = templates::guides_text(skeleton, *prepared->expanded, old ? &*old : nullptr,
                                    prepared->centimetres, controls_of(rig->scene, skeleton, names),
                                    diagnostics);
  return out;
}

}  // namespace rigc::pipeline
