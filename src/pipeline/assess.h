// SPDX-License-Identifier: MIT
// What an update would do to a rig, told from who made it and what is installed: nothing of the
// rig's scene is needed. Test: tests/pipeline/assess_test.cpp
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "catalog/catalogue.h"
#include "tags/tags.h"
#include "templates/versions.h"

namespace rigc::pipeline {

/// A template of the rig beside the one that is found now.
enum class TemplateState : std::uint8_t {
  current,
  newer,    ///< there is a higher version
  changed,  ///< the same version has another content
  older,    ///< only lower versions are found: the rig is newer than what is installed
  missing   ///< no version is found
};

/// A module that made something beside the one of this program.
enum class ModuleState : std::uint8_t { current, newer, older, unknown };

/// What `rigc update` would do.
enum class Action : std::uint8_t {
  nothing,
  update,   ///< to a higher version of the template or of a part
  rebuild,  ///< the same version, whose content or modules changed
  cannot    ///< the reason says why
};

struct TemplateStatus {
  std::string name;
  std::string file;  ///< as the rig has it: `biped.yaml`, `parts/arm`
  int version = 0;
  int found = 0;  ///< 0: none
  TemplateState state = TemplateState::current;
  std::string path;  ///< of the one that is found
};

struct ModuleStatus {
  std::string name;
  int version = 0;
  int found = 0;  ///< 0: this program has no such module
  ModuleState state = ModuleState::current;
};

struct Fork {
  std::string name;
  int version = 0;
};

struct Assessment {
  Action action = Action::nothing;
  std::string reason;                     ///< what differs, for people; empty for nothing
  bool lost = false;                      ///< cannot: something is not found, not only older
  std::vector<TemplateStatus> templates;  ///< the main one first
  std::vector<ModuleStatus> modules;
  std::vector<Fork> forks;  ///< of the main template: followed only where `--to` says so
  bool needs_update() const { return action == Action::update || action == Action::rebuild; }
};

/// The templates and modules that there are now. Threads may share it.
class Installed {
 public:
  /// `folders`: of templates, as templates::template_folders gives them.
  Installed(std::vector<std::string> folders, const catalog::Catalogue& catalogue);

  const templates::Versions& versions() const { return versions_; }

  /// `templates` and `modules` as a rig has them: TaggedSkeleton::templates, Rig::modules. A main
  /// template is looked for by its name; which file a part is, the newest main template decides.
  Assessment assess(const std::vector<tags::TemplateReference>& templates,
                    const std::vector<std::pair<std::string, int>>& modules) const;

 private:
  /// A file that a part's reference leads to.
  struct PartFile {
    std::string reference;
    templates::TemplateVersion file;
  };

  TemplateStatus main_status(const tags::TemplateReference& made) const;
  TemplateStatus part_status(const tags::TemplateReference& made, const std::string& main) const;
  const std::vector<PartFile>& parts_of(const std::string& main) const;
  void add_parts(const std::string& outer, std::set<std::string>& seen,
                 std::vector<PartFile>& out) const;
  ModuleStatus module_status(const std::string& name, int version) const;

  std::vector<std::string> folders_;
  const catalog::Catalogue& catalogue_;
  templates::Versions versions_;
  mutable std::mutex mutex_;
  /// Parts of main templates, by their paths: a thousand shots ask for the same few.
  mutable std::map<std::string, std::vector<PartFile>> parts_;
};

std::string_view name_of(TemplateState state);
std::string_view name_of(ModuleState state);
std::string_view name_of(Action action);

}  // namespace rigc::pipeline
