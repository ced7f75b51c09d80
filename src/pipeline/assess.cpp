// SPDX-License-Identifier: MIT
// Compares who made a rig with what is installed. Test: tests/pipeline/assess_test.cpp
#include "pipeline/assess.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "base/ids.h"
#include "base/text.h"
#include "templates/library.h"

namespace rigc::pipeline {
namespace {

using templates::TemplateVersion;

constexpr std::uint64_t kMostBytes = 4u << 20;
constexpr std::size_t kMostParts = 4096;
constexpr std::size_t kMostReasons = 5;

/// A template file and its text; nothing where it is none.
std::optional<std::pair<TemplateVersion, std::string>> read_part(const std::string& path) {
  Diagnostics quiet;  // who builds from the file is told what is wrong with it
  auto text = read_file(path, kMostBytes, quiet);
  auto head = text ? templates::scan_head(*text) : std::nullopt;
  if (!head) return std::nullopt;
  TemplateVersion file;
  file.name = std::move(head->name);
  file.version = head->version;
  file.digest = hex16(hash64(*text));
  file.path = path;
  return std::pair(std::move(file), std::move(*text));
}

TemplateState state_of(const tags::TemplateReference& made, const TemplateVersion& found) {
  if (found.version > made.version) return TemplateState::newer;
  if (found.version < made.version) return TemplateState::older;
  const bool same = made.digest.empty() || made.digest == found.digest;
  return same ? TemplateState::current : TemplateState::changed;
}

TemplateStatus status_of(const tags::TemplateReference& made, const TemplateVersion& found) {
  TemplateStatus status{made.name, made.file, made.version, found.version, TemplateState::missing,
                        found.path};
  if (found.version > 0) status.state = state_of(made, found);
  return status;
}

/// What differs, and whether that lets an update go ahead.
class Judge {
 public:
  explicit Judge(Assessment& out) : out_(out) {}

  void run() {
    if (out_.templates.empty())
      lose("the rig does not say which template made it");
    else
      judge_main(out_.templates.front());
    moves_ = out_.action == Action::update;
    edited_ = std::any_of(out_.templates.begin(), out_.templates.end(), [](const auto& made) {
      return made.state == TemplateState::newer || made.state == TemplateState::changed;
    });
    if (out_.action != Action::cannot) {
      for (std::size_t i = 1; i < out_.templates.size(); ++i) judge_part(out_.templates[i]);
      for (const ModuleStatus& module : out_.modules) judge_module(module);
    }
    std::vector<std::string>& told = out_.action == Action::cannot ? stops_ : reasons_;
    if (told.size() > kMostReasons) {
      const std::size_t more = told.size() - kMostReasons;
      told.resize(kMostReasons);
      told.push_back(fmt::format("and {} more", more));
    }
    out_.reason = join(told, "; ");
  }

 private:
  void judge_main(const TemplateStatus& main) {
    const std::string name = printable(main.name, 60);
    switch (main.state) {
      case TemplateState::missing:
        return lose(fmt::format("no template {} is found", name));
      case TemplateState::older:
        return stop(
            fmt::format("made by {} {}, but only {} is found", name, main.version, main.found));
      case TemplateState::newer:
        return found(Action::update, fmt::format("{} {} -> {}", name, main.version, main.found));
      case TemplateState::changed:
        return found(Action::rebuild, name + " changed without a new version");
      case TemplateState::current:
        return;
    }
  }

  /// A newer main template may have other parts: what the old one had no longer counts. One that is
  /// gone may be gone from any template that somebody edited.
  void judge_part(const TemplateStatus& part) {
    const std::string name = printable(part.file.empty() ? part.name : part.file, 60);
    switch (part.state) {
      case TemplateState::missing:
        return edited_ ? void() : lose(fmt::format("part {} is not found", name));
      case TemplateState::older:
        return moves_ ? void()
                      : stop(fmt::format("made with part {} {}, but {} is found", name,
                                         part.version, part.found));
      case TemplateState::newer:
        return found(Action::update,
                     fmt::format("part {} {} -> {}", name, part.version, part.found));
      case TemplateState::changed:
        return found(Action::rebuild, fmt::format("part {} changed without a new version", name));
      case TemplateState::current:
        return;
    }
  }

  /// An edited template need not use a module that is gone.
  void judge_module(const ModuleStatus& module) {
    const std::string name = printable(module.name, 60);
    switch (module.state) {
      case ModuleState::unknown:
        return edited_ ? void() : lose(fmt::format("there is no module {}", name));
      case ModuleState::older:
        return stop(fmt::format("made by module {} {}, this rigc has {}", name, module.version,
                                module.found));
      case ModuleState::newer:
        return found(Action::rebuild,
                     fmt::format("module {} {} -> {}", name, module.version, module.found));
      case ModuleState::current:
        return;
    }
  }

  void found(Action action, std::string reason) {
    const bool more = out_.action == Action::rebuild && action == Action::update;
    if (out_.action == Action::nothing || more) out_.action = action;
    reasons_.push_back(std::move(reason));
  }

  void stop(std::string reason) {
    out_.action = Action::cannot;
    stops_.push_back(std::move(reason));
  }

  void lose(std::string reason) {
    out_.lost = true;
    stop(std::move(reason));
  }

  Assessment& out_;
  bool moves_ = false;   ///< the main template is newer
  bool edited_ = false;  ///< a template is newer or has another content
  std::vector<std::string> reasons_, stops_;
};

}  // namespace

Installed::Installed(std::vector<std::string> folders, const catalog::Catalogue& catalogue)
    : folders_(std::move(folders)), catalogue_(catalogue), versions_(folders_) {}

Assessment Installed::assess(const std::vector<tags::TemplateReference>& templates,
                             const std::vector<std::pair<std::string, int>>& modules) const {
  Assessment out;
  std::string main;  // path of the one whose parts follow
  for (const tags::TemplateReference& made : templates) {
    const bool is_main = out.templates.empty() || made.main;
    out.templates.push_back(is_main ? main_status(made) : part_status(made, main));
    if (is_main) main = out.templates.back().path;
  }
  for (const auto& [name, version] : modules) out.modules.push_back(module_status(name, version));
  if (!templates.empty())
    for (const TemplateVersion* fork : versions_.forks(templates.front().name))
      out.forks.push_back({fork->name, fork->version});
  Judge(out).run();
  return out;
}

TemplateStatus Installed::main_status(const tags::TemplateReference& made) const {
  const TemplateVersion* newest = versions_.newest(made.name);
  return status_of(made, newest ? *newest : TemplateVersion());
}

TemplateStatus Installed::part_status(const tags::TemplateReference& made,
                                      const std::string& main) const {
  const TemplateVersion* best = nullptr;
  for (const PartFile& part : parts_of(main)) {
    if (part.reference != made.file) continue;
    // Parts of one reference may lie in several folders: first the same, then one of the same name.
    if (part.file.digest == made.digest) return status_of(made, part.file);
    if (!best || (best->name != made.name && part.file.name == made.name)) best = &part.file;
  }
  return status_of(made, best ? *best : TemplateVersion());
}

const std::vector<Installed::PartFile>& Installed::parts_of(const std::string& main) const {
  const std::lock_guard lock(mutex_);
  const auto [known, is_new] = parts_.try_emplace(main);
  if (is_new) {
    std::set<std::string> seen;
    add_parts(main, seen, known->second);
  }
  return known->second;
}

/// In the order in which the template would be expanded.
void Installed::add_parts(const std::string& outer, std::set<std::string>& seen,
                          std::vector<PartFile>& out) const {
  const auto read = read_part(outer);
  if (!read || seen.size() == kMostParts || !seen.insert(outer).second) return;
  for (const std::string& reference : templates::scan_parts(read->second)) {
    const auto path = templates::part_file(reference, folder_of(outer), folders_);
    auto part = path ? read_part(*path) : std::nullopt;
    if (!part) continue;
    out.push_back({reference, std::move(part->first)});
    add_parts(*path, seen, out);
  }
}

ModuleStatus Installed::module_status(const std::string& name, int version) const {
  const catalog::Descriptor* module = catalogue_.find(name);
  if (!module) return {name, version, 0, ModuleState::unknown};
  return {name, version, module->version,
          module->version > version   ? ModuleState::newer
          : module->version < version ? ModuleState::older
                                      : ModuleState::current};
}

std::string_view name_of(TemplateState state) {
  constexpr std::string_view kNames[] = {"current", "newer", "changed", "older", "missing"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string_view name_of(ModuleState state) {
  constexpr std::string_view kNames[] = {"current", "newer", "older", "unknown"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string_view name_of(Action action) {
  constexpr std::string_view kNames[] = {"nothing", "update", "rebuild", "cannot"};
  return kNames[static_cast<std::size_t>(action)];
}

}  // namespace rigc::pipeline
