// SPDX-License-Identifier: MIT
// Update: moves the rigs of files to other versions of their templates and keeps every key. Test:
// tests/pipeline/update_test.cpp
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "gltf/rig_summary.h"
#include "pipeline/assess.h"
#include "pipeline/batch.h"
#include "pipeline/environment.h"
#include "pipeline/place_again.h"
#include "pipeline/recompile.h"
#include "templates/library.h"

namespace rigc::pipeline {

struct UpdateSettings : CarryOptions {
  std::string to;  ///< template to follow: file, NAME, NAME@VERSION; empty: the newest
  std::vector<std::string> rigs;  ///< global groups to update; empty: all
  bool take_skeleton = false;     ///< joints go where the new template has them
  bool verbose = false;           ///< summaries list every control and property
  Paths paths;
};

/// Reads templates once and updates any number of files with them, from several threads.
class Updater {
 public:
  /// Null where modules or the template of `to` have errors.
  static std::unique_ptr<Updater> make(const UpdateSettings& settings, Diagnostics& diagnostics);

  /// Updates one file: thread-safe.
  FileResult update(const FileWork& work, Diagnostics& diagnostics) const;

 private:
  /// A template as rigs of every file share it.
  struct Loaded {
    Diagnostics diagnostics;
    std::optional<templates::Expanded> expanded;
  };
  /// What is to be done with a rig. Rigs that were joined have several main templates.
  struct Step {
    std::vector<const Loaded*> mains;  ///< by main template of the rig; empty: nothing
    std::string why;
    bool held = false;  ///< nothing, because what is installed is older: a warning said so
  };

  explicit Updater(UpdateSettings settings) : settings_(std::move(settings)) {}
  const Loaded* load(const std::string& path) const;
  bool find_step(const std::string& path, const std::string& global,
                 const std::vector<tags::TemplateReference>& templates,
                 const std::vector<std::pair<std::string, int>>& modules, Step& step,
                 Diagnostics& diagnostics) const;
  bool concerns(const std::string& global) const;
  const KnownMaps& maps() const;
  Sources sources() const;
  std::optional<NewRig> next_rig(const Recompilation& file, const gltf::Rig& old, const Step& step,
                                 RigReport& report, Diagnostics& diagnostics) const;

  UpdateSettings settings_;
  catalog::Catalogue catalogue_;
  std::vector<std::string> folders_;
  std::unique_ptr<Installed> installed_;
  std::string to_;  ///< path
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::unique_ptr<Loaded>> loaded_;  ///< by path
  mutable std::optional<KnownMaps> maps_;
  mutable Sources sources_;  ///< that spans of all templates and maps point into
};

}  // namespace rigc::pipeline
