// SPDX-License-Identifier: MIT
// Runs a command list, forwards and backwards. Each command that ran has a journal; stepping back
// undoes exactly that command. Test: tests/processor/processor_test.cpp
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "processor/command_list.h"
#include "scene/edit.h"
#include "scene/scene.h"
#include "traversal/index.h"

namespace rigc::processor {

class Processor {
 public:
  /// All arguments outlive the processor. Makes the skeleton's joints at once. `rig`: number of the
  /// rig in its file.
  Processor(const tags::TaggedSkeleton& skeleton, const CommandList& commands,
            const catalog::Catalogue& catalogue, std::uint32_t rig = 0,
            tags::Geometry geometry = {});

  /// Runs the next command. On an error the scene is as it was before the command; the position
  /// stays.
  bool step(Diagnostics& diagnostics);
  /// Undoes the last command that ran. False at the beginning.
  bool step_back();
  /// Runs, or undoes, until the joint changes.
  bool step_joint(Diagnostics& diagnostics);
  bool step_joint_back();
  /// Runs, or rolls back, to a position: that many commands have run.
  bool go_to(std::size_t position, Diagnostics& diagnostics);
  bool run(Diagnostics& diagnostics) { return go_to(commands_.commands.size(), diagnostics); }

  std::size_t position() const { return journals_.size(); }
  /// Whether the command at a position ran or was skipped because an optional selector was empty.
  bool skipped(std::size_t command) const { return skipped_[command]; }
  const scene::Scene& scene() const { return *scene_; }
  /// The built scene; the processor is finished after this.
  scene::Scene take_scene() { return std::move(*scene_); }
  const traversal::Index& index() const { return index_; }

  /// The selector arguments of a command with what they resolve to now, for `rigc plan`.
  struct ResolvedArgument {
    std::string name;
    std::string selector;
    std::vector<std::string> found;
  };
  std::vector<ResolvedArgument> resolved(std::size_t command) const;

 private:
  void make_joints();
  bool construct(std::size_t command, scene::Edit& edit, Diagnostics& diagnostics);
  traversal::Context context(std::size_t command) const;
  std::optional<std::string> feature_off_for(std::size_t command, const Literal* argument,
                                             const Diagnostics& diagnostics);
  void report_skipped(std::size_t command, const std::string& parameter, Diagnostics& diagnostics);
  void report_idle(Diagnostics& diagnostics);

  const tags::TaggedSkeleton& skeleton_;
  const CommandList& commands_;
  const catalog::Catalogue& catalogue_;
  std::unique_ptr<scene::Scene> scene_;
  traversal::Index index_;
  std::vector<scene::Journal> journals_;
  std::vector<bool> skipped_;
  /// By feature that is off: what has nothing to work on because of it, and is not yet reported.
  std::map<std::string, std::vector<std::string>> idle_;
  std::uint32_t rig_ = 0;
  tags::Geometry geometry_;
  double side_middle_ = 0;
};

}  // namespace rigc::processor
