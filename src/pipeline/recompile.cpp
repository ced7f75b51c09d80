// SPDX-License-Identifier: MIT
// Compiles rigs of a file again. Test: tests/pipeline/update_test.cpp
#include "pipeline/recompile.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "gltf/clips.h"
#include "gltf/slim.h"
#include "gltf/vertices.h"
#include "pipeline/bake_morphs.h"
#include "pipeline/place_again.h"
#include "pipeline/update_codes.h"

namespace rigc::pipeline {
namespace {

/// Joints of skins that are not the rig's own.
std::set<int> skinned_nodes(const gltf::File& file, const gltf::Rig& rig) {
  std::set<int> out;
  const auto skins = file.root()["skins"].items();
  for (std::size_t i = 0; i < skins.size(); ++i) {
    if (rig.owned.stays.skins.contains(static_cast<int>(i))) continue;
    for (const json::Value& joint : skins[i]["joints"].items())
      out.insert(static_cast<int>(joint.integer().value_or(-1)));
  }
  return out;
}

/// Joints of ours that the new rig does not have and that a skin of others is bound to.
std::vector<std::string> skinned_joints(const gltf::File& file, const gltf::Rig& old,
                                        const gltf::Rig& fresh) {
  const std::set<int> skinned = skinned_nodes(file, old);
  if (skinned.empty()) return {};
  std::set<JointKey> known;
  for (const tags::TaggedJoint& joint : fresh.skeleton.joints) {
    known.insert(joint.key);
    known.insert(joint.was.begin(), joint.was.end());
  }
  std::vector<std::string> names;
  for (const scene::NodeId id : old.scene.nodes()) {
    const scene::Node& node = old.scene[id];
    if (node.is_skeleton() && known.count(node.identity.owner) == 0 &&
        skinned.count(old.nodes[id.index]))
      names.push_back(node.name);
  }
  return names;
}

/// Meshes of the model, not of what a rig made to be seen.
tags::Geometry model_geometry(const gltf::File& file, const gltf::Rig& rig) {
  std::set<int> own;
  for (const scene::NodeId id : rig.scene.nodes())
    if (!rig.scene[id].is_skeleton()) own.insert(rig.nodes[id.index]);
  return gltf::geometry_of(file, std::move(own));
}

bool check_strict(const std::string& path, const RigReport& report, Diagnostics& diagnostics) {
  if (report.carry.new_orphans == 0) return true;
  std::vector<std::string> lost;
  for (const CarriedProperty& property : report.carry.changed)
    if (property.to.empty() && lost.size() < 8) lost.push_back(property.from);
  diagnostics.report(
      codes::kWouldOrphan, Place(path),
      report.carry.new_orphans == 1
          ? fmt::format("1 property of rig \"{}\" would lose the node that it keys or sets",
                        printable(report.global))
          : fmt::format("{} properties of rig \"{}\" would lose the nodes that they key or set",
                        report.carry.new_orphans, printable(report.global)),
      "among them " + printable(join(lost, ", "), 400) +
          "; `was:` in the template says what a joint, part or command was");
  return false;
}

bool check_tolerance(const std::string& path, const RigReport& report, double tolerance,
                     Diagnostics& diagnostics) {
  const Largest largest = largest_difference(report);
  if (largest.mm <= tolerance) return true;
  const std::string where = largest.clip.empty()
                                ? "without a clip"
                                : fmt::format("in clip \"{}\"", printable(largest.clip, 60));
  diagnostics.report(
      codes::kMoves, Place(path),
      fmt::format("{} of rig \"{}\" moves by {:.4g} mm {}", printable(largest.joint, 60),
                  printable(report.global), largest.mm, where),
      fmt::format("--tolerance allows {:.4g} mm", tolerance));
  return false;
}

}  // namespace

bool is_in_place(const FileWork& work) {
  if (work.input == work.output) return true;
  const auto from = resolved_path(work.input);
  return from && from == resolved_path(work.output);
}

bool lock_input(const FileWork& work, std::optional<FileLock>& lock, Diagnostics& diagnostics) {
  if (!is_in_place(work)) return check_output_name(work.output, diagnostics);
  lock = FileLock::take(work.input, diagnostics);
  return lock.has_value();
}

bool pass_on(const FileWork& work, std::uint64_t& bytes, Diagnostics& diagnostics) {
  if (is_in_place(work)) return true;
  const auto file = gltf::open(work.input, diagnostics);
  if (!file) return false;
  gltf::Patch patch(*file);
  return write_output(patch, *file, work.output, bytes, diagnostics);
}

Largest largest_difference(const RigReport& report) {
  Largest out;
  for (const ClipComparison& clip : report.clips) {
    for (const update::Difference& joint : clip.comparison.joints) {
      out.degrees = std::max(out.degrees, joint.largest_degrees);
      if (joint.largest_mm <= out.mm) continue;
      out.mm = joint.largest_mm;
      out.joint = joint.joint;
      out.clip = clip.clip;
    }
  }
  return out;
}

std::unique_ptr<Recompilation> Recompilation::open(const std::string& path,
                                                   Diagnostics& diagnostics) {
  auto out = std::make_unique<Recompilation>();
  out->file_ = gltf::open(path, diagnostics);
  if (!out->file_) return nullptr;
  const auto slim = gltf::read_slim(*out->file_, diagnostics);
  if (!slim) return nullptr;
  auto rigs = gltf::read_rigs(*out->file_, diagnostics, gltf::Origins::templates, &*slim);
  if (!rigs) return nullptr;
  if (rigs->empty()) {
    diagnostics.report(codes::kNoRigHere, Place(path), "the file has no rig",
                       "`rigc build TEMPLATE --model FILE` gives a character one");
    return nullptr;
  }
  out->rigs_ = *std::move(rigs);
  auto clips = gltf::read_clips(*out->file_, diagnostics, &*slim);
  if (!clips) return nullptr;
  out->clips_ = std::move(clips->clips);
  out->used_ = gltf::animated_nodes(*out->file_);
  for (const gltf::Rig& rig : out->rigs_)
    out->used_.merge(gltf::nodes_with_additions(*out->file_, rig));
  return out;
}

bool Recompilation::compile(std::size_t index, NewRig next, const catalog::Catalogue& catalogue,
                            const CarryOptions& options, RigReport& report,
                            Diagnostics& diagnostics) {
  const gltf::Rig& old = rigs_[index];
  if (!check_evaluates(*file_, old, diagnostics)) return false;
  auto compiled = std::make_unique<Compiled>();
  compiled->rig = index;
  compiled->sources = diagnostics.sources();
  Compilation compilation;
  compilation.rig_id = old.id;
  compilation.declared = std::move(next.skeleton);
  compilation.settings = std::move(next.settings);
  BuildRequest request;
  request.skeleton_only = next.skeleton_only;
  std::size_t skipped = 0;
  if (!list_commands(compilation, request, catalogue, diagnostics)) return false;
  auto fresh =
      run_commands(compilation, catalogue, model_geometry(*file_, old), skipped, diagnostics);
  if (!fresh || !check_evaluates(fresh->scene, diagnostics)) return false;
  compiled->fresh = *std::move(fresh);
  if (is_fitted(old.skeleton)) report_missing_morphs(*file_, compiled->fresh, diagnostics, &old);
  update::Options remap;
  remap.keep_local = options.keep_local;
  for (const auto& [module, version] : old.modules)
    if (const catalog::Descriptor* descriptor = catalogue.find(module))
      remap.changes[module] = catalog::attribute_changes(*descriptor, version);
  compiled->carrier =
      std::make_unique<Carrier>(old, compiled->fresh, clips_, used_, catalogue, std::move(remap));
  compiled->carrier->run();
  report.global = compiled->fresh.skeleton.global;
  report.carry = compiled->carrier->report();
  report.skinned_joints = skinned_joints(*file_, old, compiled->fresh);
  if (options.strict && !check_strict(file_->path, report, diagnostics)) return false;
  auto clips = compiled->carrier->compare(diagnostics);
  if (!clips) return false;
  report.clips = *std::move(clips);
  if (options.tolerance_mm &&
      !check_tolerance(file_->path, report, *options.tolerance_mm, diagnostics))
    return false;
  const Largest largest = largest_difference(report);
  if (report.carry.baked_channels > 0 && (largest.mm > 0 || largest.degrees > 0))
    diagnostics.report(codes::kStaleBake, Place(file_->path),
                       fmt::format("{} channels on joints were baked from the old rig \"{}\"",
                                   report.carry.baked_channels, printable(report.global)),
                       "`rigc bake --keep-rig` makes them again");
  compiled_.push_back(std::move(compiled));
  return true;
}

bool Recompilation::write(const FileWork& work, std::uint64_t& bytes, Diagnostics& diagnostics) {
  if (!keep_original(work, file_->whole, diagnostics)) return false;
  gltf::Patch patch(*file_);
  std::vector<gltf::Replacement> replacements;
  for (const auto& compiled : compiled_)
    replacements.push_back(compiled->carrier->replacement(compiled->sources));
  if (!gltf::replace_rigs(patch, *file_, replacements, diagnostics)) return false;
  std::vector<gltf::ChannelEdit> edits;
  for (const auto& compiled : compiled_) {
    std::vector<gltf::ChannelEdit> own = compiled->carrier->edits();
    std::move(own.begin(), own.end(), std::back_inserter(edits));
  }
  gltf::edit_channels(patch, *file_, edits);
  return write_output(patch, *file_, work.output, bytes, diagnostics);
}

}  // namespace rigc::pipeline
