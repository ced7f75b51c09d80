// SPDX-License-Identifier: MIT
// Skeletons of new versions. Test: tests/pipeline/update_test.cpp
#include "pipeline/place_again.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/skeletons.h"
#include "pipeline/update_codes.h"
#include "tags/settings.h"
#include "templates/fit.h"
#include "templates/guides.h"
#include "update/skeleton.h"

namespace rigc::pipeline {
namespace {

using tags::TaggedSkeleton;

templates::Bindings bindings_of(const TaggedSkeleton& skeleton) {
  templates::Bindings out;
  for (const tags::TaggedJoint& joint : skeleton.joints) {
    if (joint.foreign_node >= 0)
      out.nodes.emplace(joint.key, joint.foreign_node);
    else
      out.made.insert(joint.key);
  }
  return out;
}

/// The skeleton of a file that has the rig's bones.
const tags::ForeignSkeleton* skeleton_of(const std::vector<tags::ForeignSkeleton>& skeletons,
                                         const TaggedSkeleton& rig) {
  std::set<int> nodes;
  for (const tags::TaggedJoint& joint : rig.joints)
    if (joint.foreign_node >= 0) nodes.insert(joint.foreign_node);
  const tags::ForeignSkeleton* best = nullptr;
  std::size_t most = 0;
  for (const tags::ForeignSkeleton& skeleton : skeletons) {
    std::size_t shared = 0;
    for (const tags::ForeignJoint& joint : skeleton.joints) shared += nodes.count(joint.node);
    if (shared <= most) continue;
    most = shared;
    best = &skeleton;
  }
  return best;
}

/// The skeleton without what rigc hung into it: the joints of the model alone.
tags::ForeignSkeleton without_own(const tags::ForeignSkeleton& skeleton, const gltf::Rig& rig) {
  const std::vector<int> nodes = gltf::own_nodes(rig);
  std::set<int> own(nodes.begin(), nodes.end());
  for (const gltf::Orphan& orphan : rig.orphans) own.insert(orphan.node);
  tags::ForeignSkeleton out = skeleton;
  out.joints.clear();
  std::vector<int> index;  // by joint of `skeleton`
  const auto now = [&](int joint) {
    return joint < 0 ? -1 : index[static_cast<std::size_t>(joint)];
  };
  for (const tags::ForeignJoint& joint : skeleton.joints) {
    const bool stays = own.count(joint.node) == 0 && (joint.parent < 0 || now(joint.parent) >= 0);
    index.push_back(stays ? static_cast<int>(out.joints.size()) : -1);
    if (!stays) continue;
    out.joints.push_back(joint);
    out.joints.back().parent = now(joint.parent);
  }
  for (auto& [bone, joint] : out.humanoid) joint = now(joint);
  std::erase_if(out.humanoid, [](const auto& entry) { return entry.second < 0; });
  return out;
}

bool has_new_joints(const templates::Expanded& expanded, const templates::Bindings& known) {
  return std::any_of(
      expanded.joints.begin(), expanded.joints.end(), [&](const templates::ExpandedJoint& joint) {
        const auto is_known = [&](const JointKey& key) {
          return known.nodes.count(key) != 0 || known.made.count(key) != 0;
        };
        const auto& was = joint.tagged.was;
        return !is_known(joint.tagged.key) && std::none_of(was.begin(), was.end(), is_known);
      });
}

/// Joints of one main template and its parts. Their parents may be others'.
TaggedSkeleton joints_of(const TaggedSkeleton& skeleton, std::size_t first, std::size_t last) {
  TaggedSkeleton out;
  for (const tags::TaggedJoint& joint : skeleton.joints) {
    const auto index = static_cast<std::size_t>(joint.template_index);
    if (index >= first && index < last) out.joints.push_back(joint);
  }
  return out;
}

std::optional<TaggedSkeleton> fit_again(const templates::Expanded& expanded, const gltf::File& file,
                                        const gltf::Rig& rig, const TaggedSkeleton& old,
                                        const KnownMaps* maps, Diagnostics& diagnostics) {
  const auto skeletons = gltf::read_skeletons(file, rig.settings.rest, diagnostics);
  if (!skeletons) return std::nullopt;
  const tags::ForeignSkeleton* found = skeleton_of(*skeletons, old);
  if (!found) {
    diagnostics.report(codes::kModelGone, Place(file.path),
                       fmt::format("no skeleton of the file has the joints of rig \"{}\"",
                                   printable(rig.skeleton.global, 60)));
    return std::nullopt;
  }
  const tags::ForeignSkeleton skeleton = without_own(*found, rig);
  const templates::Bindings known = bindings_of(old);
  templates::Map map;
  if (maps && has_new_joints(expanded, known)) {
    diagnostics.append(maps->diagnostics);
    if (!maps->diagnostics.ok()) return std::nullopt;
    const auto trials = templates::try_maps(maps->maps, expanded, skeleton);
    if (!trials.empty()) map = *trials.front().map;
  }
  // What there is to warn of in the fit was said when the rig was built.
  Diagnostics fitting(diagnostics.sources());
  templates::FitReport report;
  auto fresh = templates::fit(expanded, skeleton, map, report, fitting, &known);
  if (!fresh) diagnostics.append(fitting);
  return fresh;
}

template <class T, class Same>
void unite(std::vector<T>& into, const std::vector<T>& from, Same same) {
  for (const T& item : from)
    if (std::none_of(into.begin(), into.end(), [&](const T& other) { return same(other, item); }))
      into.push_back(item);
}

/// Spans point into the sources of their own main template.
void forget_places(tags::TaggedJoint& joint) {
  joint.span = {};
  for (tags::FeatureTag& feature : joint.features) feature.span = {};
  for (tags::CommandTag& command : joint.commands) {
    command.span = {};
    for (tags::Argument& argument : command.with) argument.span = argument.value.span = {};
  }
}

/// Hangs the joints of one skeleton into another, where the old rig has them.
void join(TaggedSkeleton& into, TaggedSkeleton from, const TaggedSkeleton& old) {
  const auto offset = static_cast<int>(into.joints.size());
  const auto templates = static_cast<int>(into.templates.size());
  for (tags::TaggedJoint& joint : from.joints) {
    joint.template_index += templates;
    forget_places(joint);
    if (joint.parent >= 0) {
      joint.parent += offset;
    } else if (const int was = old.find(joint.key); was >= 0) {
      const int above = old.joints[static_cast<std::size_t>(was)].parent;
      if (above >= 0) joint.parent = into.find(old.joints[static_cast<std::size_t>(above)].key);
    }
    into.joints.push_back(std::move(joint));
  }
  from.templates.front().main = true;
  into.templates.insert(into.templates.end(), from.templates.begin(), from.templates.end());
  const auto by_name = [](const auto& a, const auto& b) { return a.name == b.name; };
  unite(into.features, from.features, by_name);
  unite(into.shapes, from.shapes, by_name);
  const auto by_first = [](const auto& a, const auto& b) { return a.first == b.first; };
  unite(into.module_pins, from.module_pins, by_first);
  unite(into.groups, from.groups, by_first);
}

}  // namespace

bool is_fitted(const TaggedSkeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const tags::TaggedJoint& joint) { return joint.foreign_node >= 0; });
}

std::vector<std::size_t> main_templates(const std::vector<tags::TemplateReference>& templates) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < templates.size(); ++i)
    if (i == 0 || templates[i].main) out.push_back(i);
  return out;
}

std::optional<TaggedSkeleton> place_again(const std::vector<const templates::Expanded*>& mains,
                                          const gltf::File& file, const gltf::Rig& old,
                                          const KnownMaps* maps, bool take_skeleton,
                                          Diagnostics& diagnostics) {
  const trace::Span span("place");
  std::vector<std::size_t> begins = main_templates(old.skeleton.templates);
  begins.push_back(old.skeleton.templates.size());
  std::optional<TaggedSkeleton> out;
  for (std::size_t i = 0; i < mains.size(); ++i) {
    const TaggedSkeleton own =
        mains.size() == 1 ? old.skeleton : joints_of(old.skeleton, begins[i], begins[i + 1]);
    auto fresh = is_fitted(own) ? fit_again(*mains[i], file, old, own, maps, diagnostics)
                                : templates::place(*mains[i], diagnostics);
    if (!fresh) return std::nullopt;
    tags::set_global(*fresh, old.skeleton.global);
    if (out)
      join(*out, *std::move(fresh), old.skeleton);
    else
      out = std::move(fresh);
  }
  if (out)
    templates::keep_control_edits(*out, old.skeleton, update::counterparts(*out, old.skeleton));
  if (out && !take_skeleton) update::keep_placements(*out, old.skeleton);
  return out;
}

}  // namespace rigc::pipeline
