// SPDX-License-Identifier: MIT
// Updates files. Test: tests/pipeline/update_test.cpp
#include "pipeline/update.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "base/text.h"
#include "pipeline/update_codes.h"
#include "tags/settings.h"
#include "templates/expand.h"
#include "update/skeleton.h"

namespace rigc::pipeline {
namespace {

using tags::TaggedSkeleton;

bool same_templates(const std::vector<tags::TemplateReference>& a,
                    const std::vector<tags::TemplateReference>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const tags::TemplateReference& x, const tags::TemplateReference& y) {
                      return x.name == y.name && x.version == y.version && x.digest == y.digest;
                    });
}

/// What a local group of the old skeleton is called now: a part has another name, and its joints
/// know. Empty: the group is still there, or its joints are in several.
std::string new_name(const std::string& group, const TaggedSkeleton& fresh,
                     const TaggedSkeleton& old, const std::vector<int>& counterparts) {
  std::string name;
  for (std::size_t i = 0; i < counterparts.size(); ++i) {
    const std::string& now = fresh.joints[i].ids.local;
    if (now == group) return {};
    if (counterparts[i] < 0 ||
        old.joints[static_cast<std::size_t>(counterparts[i])].ids.local != group)
      continue;
    if (!name.empty() && name != now) return {};
    name = now;
  }
  return name;
}

/// Settings of the old skeleton as they are said of the new one.
tags::Settings renamed_settings(tags::Settings settings, const TaggedSkeleton& fresh,
                                const TaggedSkeleton& old) {
  if (settings.features.empty() && settings.groups.empty()) return settings;
  const std::vector<int> counterparts = update::counterparts(fresh, old);
  const auto rename = [&](std::string& group) {
    if (group.empty()) return;
    const std::string now = new_name(group, fresh, old, counterparts);
    if (!now.empty()) group = now;
  };
  for (tags::Settings::Feature& feature : settings.features) rename(feature.group);
  for (auto& group : settings.groups) rename(group.first);
  return settings;
}

/// Settings without those that a skeleton does not have.
tags::Settings known_settings(const tags::Settings& settings, const TaggedSkeleton& skeleton,
                              std::vector<std::string>& dropped) {
  tags::Settings out;
  out.rest = settings.rest;
  out.split_weights = settings.split_weights;
  const auto takes = [&](tags::Settings one) {
    TaggedSkeleton copy;  // names only
    copy.features = skeleton.features;
    copy.groups = skeleton.groups;
    for (const tags::TaggedJoint& joint : skeleton.joints) {
      tags::TaggedJoint& slim = copy.joints.emplace_back();
      slim.ids = joint.ids;
      slim.features = joint.features;
    }
    Diagnostics unheard;
    return tags::apply(copy, one, unheard);
  };
  if (takes(settings)) return settings;
  for (const tags::Settings::Feature& feature : settings.features) {
    tags::Settings one;
    one.features.push_back(feature);
    if (takes(one))
      out.features.push_back(feature);
    else
      dropped.push_back((feature.group.empty() ? "" : feature.group + "/") + feature.name +
                        (feature.switch_name.empty() ? "" : ":" + feature.switch_name));
  }
  for (const auto& group : settings.groups) {
    tags::Settings one;
    one.groups.push_back(group);
    if (takes(one))
      out.groups.push_back(group);
    else
      dropped.push_back(group.first);
  }
  return out;
}

std::string quoted(const std::string& text) { return "\"" + printable(text, 60) + "\""; }

/// Why a rig cannot be updated. False where something is lost; what is only older is a warning.
bool report_stop(const std::string& path, const std::string& global, const Assessment& assessment,
                 Diagnostics& diagnostics) {
  const std::string what =
      fmt::format("rig {} cannot be updated: {}", quoted(global), assessment.reason);
  if (assessment.lost) {
    diagnostics.report(codes::kTemplateLost, Place(path), what,
                       "--templates DIR adds a folder of templates, --modules DIR one of modules");
    return false;
  }
  const TemplateStatus& main = assessment.templates.front();
  diagnostics.report(
      codes::kOlderOnly, Place(path), what,
      fmt::format("--to {}@{} builds it with what there is", printable(main.name), main.found));
  return true;
}

}  // namespace

std::unique_ptr<Updater> Updater::make(const UpdateSettings& settings, Diagnostics& diagnostics) {
  std::unique_ptr<Updater> out(new Updater(settings));
  if (!add_modules(settings.paths, out->catalogue_, diagnostics)) return nullptr;
  out->folders_ = templates::template_folders(settings.paths.templates);
  out->installed_ = std::make_unique<Installed>(out->folders_, out->catalogue_);
  if (!out->installed_->versions().check_readable(diagnostics)) return nullptr;
  if (!settings.to.empty()) {
    const auto path = out->installed_->versions().resolve(settings.to, diagnostics);
    if (!path) return nullptr;
    out->to_ = *path;
    const Loaded* loaded = out->load(*path);
    if (!loaded->expanded) {
      diagnostics.append(loaded->diagnostics);
      return nullptr;
    }
  }
  return out;
}

const Updater::Loaded* Updater::load(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<Loaded>& loaded = loaded_[path];
  if (loaded) return loaded.get();
  loaded = std::make_unique<Loaded>();
  loaded->diagnostics = Diagnostics(sources_);
  templates::Library library(folders_, catalogue_);
  if (const templates::Template* main = library.open(path, loaded->diagnostics))
    loaded->expanded = templates::expand(*main, library, catalogue_, loaded->diagnostics);
  sources_ = loaded->diagnostics.sources();
  return loaded.get();
}

const KnownMaps& Updater::maps() const {
  const std::lock_guard lock(mutex_);
  if (maps_) return *maps_;
  maps_.emplace();
  maps_->diagnostics = Diagnostics(sources_);
  maps_->maps = templates::all_maps(folders_, maps_->diagnostics);
  sources_ = maps_->diagnostics.sources();
  return *maps_;
}

Sources Updater::sources() const {
  const std::lock_guard lock(mutex_);
  return sources_;
}

bool Updater::concerns(const std::string& global) const {
  return settings_.rigs.empty() ||
         std::find(settings_.rigs.begin(), settings_.rigs.end(), global) != settings_.rigs.end();
}

/// What is to be done with a rig; false where its template cannot be had.
bool Updater::find_step(const std::string& path, const std::string& global,
                        const std::vector<tags::TemplateReference>& templates,
                        const std::vector<std::pair<std::string, int>>& modules, Step& step,
                        Diagnostics& diagnostics) const {
  if (!concerns(global)) return true;
  const Assessment assessment = installed_->assess(templates, modules);
  if (templates.empty()) return report_stop(path, global, assessment, diagnostics);
  const std::vector<std::size_t> mains = main_templates(templates);
  std::vector<std::string> files;
  for (const std::size_t main : mains) {
    const TemplateStatus& status = assessment.templates[main];
    files.push_back(main == 0 && !to_.empty() ? to_ : status.path);
    if (!files.back().empty() && (status.state != TemplateState::older || files.back() == to_))
      continue;
    if (status.state != TemplateState::older) {
      diagnostics.report(codes::kTemplateLost, Place(path),
                         fmt::format("rig {} was made by template {} version {}, which is in none "
                                     "of the template folders",
                                     quoted(global), quoted(status.name), status.version),
                         "--templates DIR adds a folder; --to TEMPLATE names the one to follow");
      return false;
    }
    diagnostics.report(
        codes::kOlderOnly, Place(path),
        fmt::format("rig {} was made by version {} of template {}; the newest found is {}",
                    quoted(global), status.version, quoted(status.name), status.found),
        fmt::format("--to {}@{} goes back", printable(status.name), status.found));
    step.held = true;
    return true;
  }
  if (to_.empty() && assessment.action == Action::cannot) {
    step.held = true;
    return report_stop(path, global, assessment, diagnostics);
  }
  step.why = assessment.reason;
  if (to_.empty() && !assessment.needs_update() && !settings_.take_skeleton) return true;
  for (const std::string& file : files) {
    const Loaded* loaded = load(file);
    if (!loaded->expanded) {
      diagnostics.append(loaded->diagnostics);
      return false;
    }
    step.mains.push_back(loaded);
  }
  if (to_.empty()) return true;
  const std::vector<tags::TemplateReference>& now =
      step.mains.front()->expanded->skeleton.templates;
  step.why = now.front().name != templates.front().name         ? "another template"
             : now.front().version != templates.front().version ? "another version"
                                                                : "changed content";
  const bool same_modules =
      std::all_of(assessment.modules.begin(), assessment.modules.end(),
                  [](const ModuleStatus& module) { return module.state == ModuleState::current; });
  if (mains.size() == 1 && same_modules && same_templates(now, templates) &&
      !settings_.take_skeleton)
    step.mains.clear();
  return true;
}

std::optional<NewRig> Updater::next_rig(const Recompilation& file, const gltf::Rig& old,
                                        const Step& step, RigReport& report,
                                        Diagnostics& diagnostics) const {
  std::vector<const templates::Expanded*> mains;
  for (const Loaded* loaded : step.mains) mains.push_back(&*loaded->expanded);
  auto skeleton = place_again(mains, file.file(), old, is_fitted(old.skeleton) ? &maps() : nullptr,
                              settings_.take_skeleton, diagnostics);
  if (!skeleton) return std::nullopt;
  NewRig next;
  next.settings = known_settings(renamed_settings(old.settings, *skeleton, old.skeleton), *skeleton,
                                 report.dropped_settings);
  for (const std::string& setting : report.dropped_settings)
    diagnostics.report(codes::kSettingGone, Place(file.file().path),
                       fmt::format("the new version has no {}, which rig {} was built with a "
                                   "setting for",
                                   quoted(setting), quoted(old.skeleton.global)));
  next.skeleton = *std::move(skeleton);
  next.skeleton_only = old.commands.empty();  // it was taken apart, and stays so
  return next;
}

FileResult Updater::update(const FileWork& work, Diagnostics& diagnostics) const {
  FileResult result;
  std::optional<FileLock> lock;
  if (!settings_.plan && !lock_input(work, lock, diagnostics)) return result;
  const auto summaries = gltf::read_rig_summaries(work.input, diagnostics);
  if (!summaries) return result;
  bool concerned = false, named = false, held = false, good = true;
  for (const gltf::RigSummary& rig : *summaries) {
    named = named || concerns(rig.global);
    Step step;
    good = find_step(work.input, rig.global, rig.templates, rig.modules, step, diagnostics) && good;
    concerned = concerned || !step.mains.empty();
    held = held || step.held;
  }
  if (!good) return result;
  if (!concerned) {
    result.summary = summaries->empty() ? "has no rig"
                     : held             ? "is left as it is"
                     : named            ? "is up to date"
                                        : "has no rig of that name";
    if (!settings_.plan) pass_on(work, result.bytes, diagnostics);
    return result;
  }
  Diagnostics reading;
  const auto file = Recompilation::open(work.input, reading);
  diagnostics.append(reading);
  if (!file) return result;

  std::vector<RigReport> reports;
  for (std::size_t i = 0; i < file->rigs().size(); ++i) {
    const gltf::Rig& old = file->rigs()[i];
    Step step;
    const auto& made_by = old.skeleton.templates;
    Diagnostics said_before;
    if (!find_step(work.input, old.skeleton.global, made_by, old.modules, step, said_before)) {
      diagnostics.append(said_before);
      return result;
    }
    if (step.mains.empty()) continue;
    RigReport& report = reports.emplace_back();
    const tags::TemplateReference& now = step.mains.front()->expanded->skeleton.templates.front();
    report.why = step.why;
    report.template_before = made_by.front().name;
    report.version_before = made_by.front().version;
    report.template_name = now.name;
    report.version = now.version;
    if (is_fitted(old.skeleton)) maps();  // before the sources are taken
    // What is written names lines of the templates.
    Diagnostics building(sources());
    auto next = next_rig(*file, old, step, report, building);
    const bool built =
        next && file->compile(i, *std::move(next), catalogue_, settings_, report, building);
    diagnostics.append(building);
    if (!built) return result;
  }
  result.outcome = FileResult::Outcome::changed;
  result.summary = settings_.plan ? "would be updated" : "updated";
  json::Writer writer;
  writer.begin_object().key("rigs").begin_array();
  for (const RigReport& report : reports) {
    result.summary += "\n" + as_text(report, settings_.verbose);
    write_json(writer, report);
  }
  result.json = writer.end_array().end_object().take();
  if (settings_.plan) return result;
  file->write(work, result.bytes, diagnostics);
  return result;
}

}  // namespace rigc::pipeline
