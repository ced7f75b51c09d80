// SPDX-License-Identifier: MIT
// The command list: which commands run, in which order. Stage by stage, inside a stage joint by
// joint, parents before children in document order, on a joint top to bottom. Test:
// tests/processor/command_list_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "catalog/catalogue.h"
#include "modules/builder.h"
#include "tags/tags.h"

namespace rigc::processor {

struct Command {
  std::size_t joint = 0;  ///< index in the skeleton
  std::size_t tag = 0;    ///< index in the joint's commands
  catalog::Stage stage = catalog::Stage::build;
  const catalog::Descriptor* descriptor = nullptr;  ///< owned by the catalogue
  const modules::Module* module = nullptr;
  /// Of the module whose constructor runs, where the descriptor names another one; else null.
  const catalog::Descriptor* base = nullptr;
};

struct CommandList {
  std::vector<Command> commands;
};

/// Lists the commands that are on. Features, switches and groups were applied to the tags before.
std::optional<CommandList> list(const tags::TaggedSkeleton& skeleton,
                                const catalog::Catalogue& catalogue, Diagnostics& diagnostics);

/// Keeps the commands on joints of these groups (`--only`).
std::optional<CommandList> only(CommandList commands, const tags::TaggedSkeleton& skeleton,
                                const std::vector<std::string>& groups, Diagnostics& diagnostics);

/// How many commands run up to and with the one that `JOINT/COMMAND` names (`--until`).
std::optional<std::size_t> until(const CommandList& commands, const tags::TaggedSkeleton& skeleton,
                                 const std::string& name, Diagnostics& diagnostics);

inline const tags::CommandTag& tag_of(const tags::TaggedSkeleton& skeleton,
                                      const Command& command) {
  return skeleton.joints[command.joint].commands[command.tag];
}

}  // namespace rigc::processor
