// SPDX-License-Identifier: MIT
// Build: template to rig. Test: tests/pipeline/build_test.cpp
#include "pipeline/build.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/files.h"
#include "base/text.h"
#include "base/trace.h"
#include "gltf/skeletons.h"
#include "gltf/vertices.h"
#include "pipeline/bake_morphs.h"
#include "pipeline/codes.h"
#include "pipeline/guides.h"
#include "tags/settings.h"
#include "templates/expand.h"
#include "templates/library.h"

namespace rigc::pipeline {
namespace {

/// A feature of this name brings bodies for rigs without a model; with one it is off unless
/// somebody asks for it.
constexpr std::string_view kProxyFeature = "proxy";

bool read_settings(const BuildRequest& request, const templates::Expanded& expanded,
                   tags::Settings& settings, Diagnostics& diagnostics) {
  const auto& declared = expanded.skeleton.features;
  const bool has_proxy = std::any_of(declared.begin(), declared.end(), [](const auto& feature) {
    return feature.name == kProxyFeature;
  });
  if (!request.model.empty() && has_proxy) {
    settings.features.push_back({"", std::string(kProxyFeature), "", false});
  }
  bool good = true;
  for (const std::string& text : request.features) {
    const auto feature = tags::parse_feature_setting(text, diagnostics);
    if (feature) settings.features.push_back(*feature);
    good = good && feature;
  }
  for (const std::string& text : request.groups) {
    const auto group = tags::parse_group_setting(text, diagnostics);
    if (group) settings.groups.push_back(*group);
    good = good && group;
  }
  settings.rest = request.rest;
  settings.split_weights = request.split_weights;
  return good;
}

std::string skeleton_names(const std::vector<tags::ForeignSkeleton>& skeletons) {
  std::vector<std::string> names;
  for (const auto& skeleton : skeletons) {
    const tags::ForeignJoint& first = skeleton.joints.front();
    names.push_back(fmt::format("{} (\"{}\", {} joints)", first.node, printable(first.name),
                                skeleton.joints.size()));
  }
  return "--skeleton takes one of: " + join(names, ", ");
}

}  // namespace

const tags::ForeignSkeleton* choose_skeleton(const std::vector<tags::ForeignSkeleton>& skeletons,
                                             const BuildRequest& request,
                                             Diagnostics& diagnostics) {
  if (skeletons.empty()) {
    diagnostics.report(codes::kNoSkeleton, Place(request.model), "the model has no skeleton");
    return nullptr;
  }
  if (request.skeleton.empty()) {
    if (skeletons.size() == 1) return &skeletons.front();
    diagnostics.report(codes::kSeveralSkeletons, Place(request.model),
                       fmt::format("the model has {} skeletons", skeletons.size()),
                       skeleton_names(skeletons));
    return nullptr;
  }
  const auto number = parse_integer(request.skeleton);
  for (const auto& skeleton : skeletons) {
    for (const tags::ForeignJoint& joint : skeleton.joints) {
      if (joint.name == request.skeleton || (number && joint.node == *number)) return &skeleton;
    }
  }
  diagnostics.report(codes::kNoSuchSkeleton, Place(request.model),
                     fmt::format("no skeleton has a node \"{}\"", printable(request.skeleton)),
                     skeleton_names(skeletons));
  return nullptr;
}

namespace {

/// The number of the rig to be, if no rig stands on the skeleton yet.
std::optional<std::uint32_t> free_rig_id(const gltf::File& model,
                                         const tags::ForeignSkeleton& skeleton,
                                         Diagnostics& diagnostics) {
  const auto rigs = gltf::read_rigs(model, diagnostics);
  if (!rigs) return std::nullopt;
  std::set<int> taken;
  std::uint32_t next = 0;
  for (const gltf::Rig& rig : *rigs) {
    for (const tags::TaggedJoint& joint : rig.skeleton.joints) taken.insert(joint.foreign_node);
    taken.insert(rig.nodes.begin(), rig.nodes.end());
    next = std::max(next, rig.id + 1);
  }
  for (const tags::ForeignJoint& joint : skeleton.joints) {
    if (!taken.count(joint.node)) continue;
    diagnostics.report(codes::kHasRig, Place(model.path, fmt::format("/nodes/{}", joint.node)),
                       "this skeleton has a rig already",
                       "`rigc update` moves it to another template version");
    return std::nullopt;
  }
  return next;
}

std::optional<tags::TaggedSkeleton> fit_to_model(const BuildRequest& request,
                                                 const templates::Expanded& expanded,
                                                 const std::vector<std::string>& folders,
                                                 Prepared& out, Diagnostics& diagnostics) {
  out.model = gltf::open(request.model, diagnostics);
  if (!out.model) return std::nullopt;
  const auto skeletons = gltf::read_skeletons(*out.model, request.rest, diagnostics);
  if (!skeletons) return std::nullopt;
  const tags::ForeignSkeleton* skeleton = choose_skeleton(*skeletons, request, diagnostics);
  if (!skeleton) return std::nullopt;
  const auto id = free_rig_id(*out.model, *skeleton, diagnostics);
  if (!id) return std::nullopt;
  out.rig_id = *id;
  out.ancestor = skeleton->ancestor;
  const auto map = request.map.empty()
                       ? templates::detect_map(expanded, *skeleton, folders, diagnostics)
                       : templates::find_map(request.map, folders, diagnostics);
  if (!map) return std::nullopt;
  const bool own = !request.map.empty() && map->name != request.map;  // a user's, not one by name
  if (own) templates::check_map(*map, expanded, *skeleton, diagnostics);
  return templates::fit(expanded, *skeleton, *map, out.fit, diagnostics);
}

bool use_guides(const BuildRequest& request, const Prepared& prepared,
                tags::TaggedSkeleton& skeleton, Diagnostics& diagnostics) {
  const auto guides = templates::open_guides(request.guides, prepared.catalogue, diagnostics);
  std::vector<std::string> put_back;  // nothing was moved before
  return guides && check_guides_of(*guides, prepared.names, diagnostics) &&
         apply_guides(*guides, &*prepared.expanded, prepared.catalogue, skeleton, put_back,
                      diagnostics);
}

}  // namespace

std::optional<Prepared> prepare(const BuildRequest& request, Diagnostics& diagnostics) {
  Prepared out;
  if (!add_modules(request.paths, out.catalogue, diagnostics)) return std::nullopt;
  templates::Library library(templates::template_folders(request.paths.templates), out.catalogue);
  const templates::Template* main = library.open(request.template_file, diagnostics);
  if (!main) return std::nullopt;
  out.needs_outside = !main->needs.empty();
  out.names = {main->name};
  out.names.insert(out.names.end(), main->was.begin(), main->was.end());
  out.centimetres = main->metres_per_unit != 1;
  out.expanded = templates::expand(*main, library, out.catalogue, diagnostics);
  if (!out.expanded) return std::nullopt;
  auto skeleton = request.model.empty()
                      ? templates::place(*out.expanded, diagnostics)
                      : fit_to_model(request, *out.expanded, library.folders(), out, diagnostics);
  if (!skeleton || !read_settings(request, *out.expanded, out.settings, diagnostics))
    return std::nullopt;
  if (!request.guides.empty() && !use_guides(request, out, *skeleton, diagnostics))
    return std::nullopt;
  if (!request.global.empty()) tags::set_global(*skeleton, request.global);
  out.declared = *std::move(skeleton);
  if (!list_commands(out, request, out.catalogue, diagnostics)) return std::nullopt;
  return out;
}

bool list_commands(Compilation& out, const BuildRequest& request,
                   const catalog::Catalogue& catalogue, Diagnostics& diagnostics) {
  const trace::Span span("list commands");
  out.skeleton = out.declared;
  if (!tags::apply(out.skeleton, out.settings, diagnostics)) return false;
  auto commands = processor::list(out.skeleton, catalogue, diagnostics);
  if (commands && !request.only.empty()) {
    commands = processor::only(std::move(*commands), out.skeleton, request.only, diagnostics);
  }
  if (!commands) return false;
  out.end = request.skeleton_only ? 0 : commands->commands.size();
  if (!request.until.empty()) {
    const auto end = processor::until(*commands, out.skeleton, request.until, diagnostics);
    if (!end) return false;
    out.end = std::min(out.end, *end);
  }
  out.commands = std::move(*commands);
  return true;
}

namespace {

/// Versions of all modules that the tags name: those that are off may run another time.
std::vector<std::pair<std::string, int>> module_versions(const tags::TaggedSkeleton& skeleton,
                                                         const catalog::Catalogue& catalogue) {
  std::map<std::string, int> versions;
  for (const tags::TaggedJoint& joint : skeleton.joints)
    for (const tags::CommandTag& tag : joint.commands)
      if (const catalog::Descriptor* descriptor = catalogue.find(tag.module))
        versions[tag.module] = descriptor->version;
  return {versions.begin(), versions.end()};
}

/// What ran, for the file and for people.
void record_commands(const Compilation& compilation, const processor::Processor& processor,
                     const Sources& sources, gltf::Rig& rig) {
  for (std::size_t i = 0; i < processor.position(); ++i) {
    const processor::Command& command = compilation.commands.commands[i];
    const tags::TaggedJoint& joint = compilation.skeleton.joints[command.joint];
    const tags::CommandTag& tag = tag_of(compilation.skeleton, command);
    rig.commands.push_back({joint.key, joint.name, tag.id, tag.module, !processor.skipped(i),
                            std::string(sources.name(tag.span.file)),
                            static_cast<int>(tag.span.line)});
  }
}

}  // namespace

std::optional<gltf::Rig> run_commands(const Compilation& compilation,
                                      const catalog::Catalogue& catalogue,
                                      const tags::Geometry& geometry, std::size_t& skipped,
                                      Diagnostics& diagnostics) {
  const trace::Span span("run commands");
  processor::Processor processor(compilation.skeleton, compilation.commands, catalogue,
                                 compilation.rig_id, geometry);
  if (!processor.go_to(compilation.end, diagnostics)) return std::nullopt;
  gltf::Rig rig;
  rig.id = compilation.rig_id;
  rig.settings = compilation.settings;
  rig.modules = module_versions(compilation.declared, catalogue);
  record_commands(compilation, processor, diagnostics.sources(), rig);
  for (std::size_t i = 0; i < processor.position(); ++i) skipped += processor.skipped(i) ? 1 : 0;
  rig.scene = processor.take_scene();
  rig.skeleton = compilation.declared;
  return rig;
}

std::optional<Built> build(const BuildRequest& request, const std::string& out,
                           Diagnostics& diagnostics) {
  if (!check_output_name(out, diagnostics)) return std::nullopt;
  auto prepared = prepare(request, diagnostics);
  if (!prepared) return std::nullopt;

  Built built;
  const auto geometry = prepared->model ? gltf::geometry_of(*prepared->model) : tags::Geometry{};
  auto rig = run_commands(*prepared, prepared->catalogue, geometry, built.skipped, diagnostics);
  if (!rig) return std::nullopt;
  built.rig = *std::move(rig);
  built.fit = std::move(prepared->fit);
  if (!check_evaluates(built.rig.scene, diagnostics)) return std::nullopt;
  if (prepared->model) report_missing_morphs(*prepared->model, built.rig, diagnostics);

  const gltf::File empty = gltf::empty_file();
  const gltf::File& file = prepared->model ? *prepared->model : empty;
  gltf::Patch patch(file);
  if (!gltf::write_rig(patch, built.rig, prepared->ancestor, diagnostics)) return std::nullopt;
  if (!write_output(patch, file, out, built.bytes, diagnostics)) return std::nullopt;
  return built;
}

}  // namespace rigc::pipeline
