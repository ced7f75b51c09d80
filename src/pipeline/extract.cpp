// SPDX-License-Identifier: MIT
// Extract: rig to template. Test: tests/pipeline/extract_test.cpp
#include "pipeline/extract.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/text.h"
#include "gltf/skeletons.h"
#include "pipeline/codes.h"
#include "tags/settings.h"
#include "templates/format.h"
#include "templates/write.h"
#include "templates/write_skeleton.h"

namespace rigc::pipeline {
namespace {

constexpr double kSameRest = 1e-9;  // relative; what fitting wrote is found again to the last bits

/// What the template is called, checked.
std::optional<templates::WriteOptions> read_options(const ExtractRequest& request,
                                                    const gltf::Rig& rig,
                                                    Diagnostics& diagnostics) {
  templates::WriteOptions options;
  options.modules = rig.modules;
  options.name = request.name.empty() ? rig.skeleton.name : request.name;
  if (!is_name(options.name))
    diagnostics.report(codes::kNotATemplateName, Place(request.file),
                       fmt::format("\"{}\" cannot name a template", printable(options.name, 60)),
                       "--name takes letters, digits, `_` and `-`, not a digit first");
  if (!rig.skeleton.templates.empty()) options.version = rig.skeleton.templates.front().version;
  if (!request.version.empty()) {
    const auto version = parse_integer(request.version);
    if (version && *version >= 1 && *version <= templates::kMostVersion)
      options.version = static_cast<int>(*version);
    else
      diagnostics.report(codes::kNotATemplateName, Place(request.file),
                         fmt::format("\"{}\" is no version", printable(request.version, 60)),
                         "--version takes an integer from 1");
  }
  if (!diagnostics.ok()) return std::nullopt;
  return options;
}

std::vector<std::string> comments_of(const gltf::Rig& rig, bool fitted) {
  std::vector<std::string> lines;
  const auto& templates = rig.skeleton.templates;
  lines.push_back(fmt::format("Extracted from a rig of {}, version {}.", rig.skeleton.name,
                              templates.empty() ? 1 : templates.front().version));
  if (!fitted) return lines;
  lines.push_back("Its proportions are those of the model that the rig was fitted to; on it,");
  lines.push_back(
      fmt::format("`rigc build` with --model{} gives the same rig.",
                  rig.settings.rest == "bind" ? "" : " and --rest " + rig.settings.rest));
  return lines;
}

/// Rest matrices of a model's joints in rig space as the model has them, unless the rig has others:
/// a sheared one does not survive translation, rotation and scale.
std::vector<math::Affine> rest_worlds(const gltf::File& file, const gltf::Rig& rig) {
  Diagnostics quiet;
  const auto skeletons = gltf::read_skeletons(file, rig.settings.rest, quiet);
  std::map<int, math::Affine> by_node;
  for (std::size_t i = 0; skeletons && i < skeletons->size(); ++i)
    for (const tags::ForeignJoint& joint : (*skeletons)[i].joints)
      by_node.emplace(joint.node, joint.rest);
  const auto same = [&](const math::Trs& a, const math::Trs& b) {
    const double height = rig.skeleton.character.height;
    return math::length(a.translation - b.translation) < kSameRest * height &&
           math::length(a.scale - b.scale) < kSameRest * math::length(b.scale) &&
           std::abs(math::dot(a.rotation, b.rotation)) > 1 - kSameRest;
  };
  std::vector<math::Affine> worlds;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints) {
    const math::Affine above =
        joint.parent < 0 ? math::Affine() : worlds[static_cast<std::size_t>(joint.parent)];
    const auto known = by_node.find(joint.foreign_node);
    const bool still =
        known != by_node.end() && same(math::decompose(inverse(above) * known->second), joint.rest);
    worlds.push_back(still ? known->second : above * math::compose(joint.rest));
  }
  return worlds;
}

}  // namespace

const gltf::Rig* choose_rig(const std::vector<gltf::Rig>& rigs, const std::string& global,
                            const std::string& file, Diagnostics& diagnostics) {
  if (rigs.empty()) {
    diagnostics.report(codes::kNoRig, Place(file), "the file has no rig");
    return nullptr;
  }
  if (global.empty() && rigs.size() == 1) return &rigs.front();
  std::vector<std::string> names;
  std::vector<const gltf::Rig*> found;
  for (const gltf::Rig& rig : rigs) {
    names.push_back(rig.skeleton.global);
    if (rig.skeleton.global == global) found.push_back(&rig);
  }
  if (found.size() == 1) return found.front();
  const std::string hint = "--rig takes one of: " + printable(join(names, ", "), 300);
  if (global.empty())
    diagnostics.report(codes::kWhichRig, Place(file),
                       fmt::format("the file has {} rigs", rigs.size()), hint);
  else
    diagnostics.report(codes::kWhichRig, Place(file),
                       fmt::format("{} rig is called \"{}\"",
                                   found.empty() ? "no" : "more than one", printable(global, 60)),
                       hint);
  return nullptr;
}

std::optional<Extracted> extract(const ExtractRequest& request, Diagnostics& diagnostics) {
  catalog::Catalogue catalogue;
  if (!add_modules(request.paths, catalogue, diagnostics)) return std::nullopt;
  const auto file = gltf::open(request.file, diagnostics);
  if (!file) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return std::nullopt;
  const gltf::Rig* rig = choose_rig(*rigs, request.rig, request.file, diagnostics);
  if (!rig) return std::nullopt;
  auto options = read_options(request, *rig, diagnostics);
  if (!options) return std::nullopt;

  Extracted out;
  out.fitted = templates::was_fitted(rig->skeleton);
  options->comments = comments_of(*rig, out.fitted);
  if (out.fitted) options->worlds = rest_worlds(*file, *rig);
  out.name = options->name;
  out.version = options->version;
  out.joints = rig->skeleton.joints.size();
  for (const tags::TaggedJoint& joint : rig->skeleton.joints) out.commands += joint.commands.size();
  tags::TaggedSkeleton skeleton = rig->skeleton;
  if (!tags::apply(skeleton, rig->settings, diagnostics)) return std::nullopt;
  out.yaml = templates::write(skeleton, catalogue, *options);
  return out;
}

}  // namespace rigc::pipeline
