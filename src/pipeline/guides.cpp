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
#include "pipeline/place_again.h"
#include "tags/fitted.h"
#include "templates/chain.h"
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

/// The joints of a rig that were moved themselves, by guides or elsewhere. Those that others took
/// along are not: what is found here takes them along again.
std::vector<templates::Guide> moved_in(const tags::TaggedSkeleton& rig, tags::TaggedSkeleton fresh,
                                       const std::vector<std::string>& names) {
  const std::vector<int> counterparts = update::counterparts(fresh, rig);
  const auto place = [](const tags::TaggedSkeleton& skeleton, std::size_t joint) {
    return templates::to_template(skeleton.character, skeleton.world(joint).origin);
  };
  const std::size_t count = fresh.joints.size();
  std::vector<math::Vec3> at(count), fitted(count);
  for (std::size_t i = 0; i < count; ++i) {
    at[i] = fitted[i] = place(fresh, i);
    fresh.joints[i].guide.moved.reset();
    if (counterparts[i] < 0 || fresh.joints[i].foreign_node >= 0) continue;
    const auto other = static_cast<std::size_t>(counterparts[i]);
    at[i] = place(rig, other);
    if (rig.joints[other].guide.moved)
      fresh.joints[i].guide.moved = templates::to_rig(fresh.character, at[i] - fitted[i]);
  }
  for (bool more = true; more;) {
    more = false;
    Diagnostics unheard;
    const auto guided = templates::find_moves({}, nullptr, fresh, unheard);
    for (std::size_t i = 0; guided && i < count; ++i) {
      tags::TaggedJoint& joint = fresh.joints[i];
      const auto found = guided->places.find(joint.key);
      const math::Vec3& goes = found == guided->places.end() ? fitted[i] : found->second;
      if (counterparts[i] < 0 || joint.foreign_node >= 0 || joint.guide.moved ||
          templates::is_same_place(goes, at[i]))
        continue;
      joint.guide.moved = templates::to_rig(fresh.character, at[i] - fitted[i]);
      more = true;
    }
  }
  std::vector<templates::Guide> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (!fresh.joints[i].guide.moved) continue;
    templates::Guide& guide = out.emplace_back();
    guide.name = names[i];
    guide.at = at[i];
    if (!templates::is_same_place(at[i], fitted[i])) guide.fitted = fitted[i];
  }
  return out;
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
  for (templates::Guide& guide : moved_in(rig->skeleton, fresh, names))
    put(guides.joints, guide, [&](const auto& old) { return old.name == guide.name; });
  for (const templates::ControlEdit& edit : templates::control_edits(rig->skeleton))
    put(guides.controls, edit, [&](const auto& old) { return old.control == edit.control; });
  return true;
}

/// Up the character, from the lowest joint to the highest.
double extent(const tags::TaggedSkeleton& skeleton) {
  double lowest = 0, highest = 0;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const double at = dot(skeleton.character.up, skeleton.world(i).origin);
    lowest = i == 0 ? at : std::min(lowest, at);
    highest = i == 0 ? at : std::max(highest, at);
  }
  return highest - lowest;
}

/// A model is as high as it was; what is made of joints alone grows with them.
double height_after(const tags::TaggedSkeleton& before, const tags::TaggedSkeleton& after) {
  const double was = extent(before), is = extent(after), height = before.character.height;
  return was == is || is_fitted(before) ? height : templates::tidy_length(height + (is - was));
}

std::optional<tags::TaggedSkeleton> move_joints(const tags::TaggedSkeleton& fitted,
                                                const templates::Expanded* expanded,
                                                const templates::Moves& moves,
                                                Diagnostics& diagnostics) {
  if (!moves.empty() && expanded && !is_fitted(fitted))
    return templates::place(*expanded, fitted, moves, diagnostics);
  std::optional<tags::TaggedSkeleton> out = fitted;
  templates::move_joints(*out, moves);
  return out;
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

bool apply_guides(const templates::Guides& guides, const templates::Expanded* expanded,
                  const catalog::Catalogue& catalogue, tags::TaggedSkeleton& skeleton,
                  std::vector<std::string>& put_back, Diagnostics& diagnostics) {
  const trace::Span span("apply guides");
  const std::size_t errors_before = diagnostics.errors();
  const tags::TaggedSkeleton fitted = tags::as_fitted(skeleton);
  auto guided = templates::find_moves(guides, expanded, fitted, diagnostics);
  if (guided) {
    auto moved = move_joints(fitted, expanded, guided->places, diagnostics);
    if (!moved) return false;
    moved->character.height = height_after(skeleton, *moved);
    for (std::size_t i = 0; i < moved->joints.size(); ++i)
      moved->joints[i].guide.moved = guided->moved[i];
    tags::note_fitted(*moved, fitted);
    skeleton = *std::move(moved);
    put_back = std::move(guided->put_back);
  }
  for (std::string& control :
       templates::add_control_edits(guides, catalogue, skeleton, diagnostics))
    put_back.push_back(std::move(control));
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
