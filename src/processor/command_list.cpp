// SPDX-License-Identifier: MIT
// Makes the command list from a tagged skeleton. Test: tests/processor/command_list_test.cpp
#include "processor/command_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "processor/codes.h"

namespace rigc::processor {
namespace {

bool is_on(const tags::TaggedJoint& joint, const tags::CommandTag& tag) {
  return tag.on && (tag.feature < 0 || joint.features[static_cast<std::size_t>(tag.feature)].on);
}

/// The constructor of a module: its own, or that of the module that its descriptor names.
const modules::Module* implementation(const tags::CommandTag& tag,
                                      const catalog::Descriptor* descriptor) {
  if (!descriptor) return nullptr;
  const bool own = descriptor->implementation == "builtin";
  return modules::find(own ? tag.module : descriptor->implementation);
}

}  // namespace

std::optional<CommandList> list(const tags::TaggedSkeleton& skeleton,
                                const catalog::Catalogue& catalogue, Diagnostics& diagnostics) {
  CommandList out;
  bool good = true;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const tags::TaggedJoint& joint = skeleton.joints[j];
    for (std::size_t t = 0; t < joint.commands.size(); ++t) {
      const tags::CommandTag& tag = joint.commands[t];
      if (!is_on(joint, tag)) continue;
      const catalog::Descriptor* descriptor = catalogue.find(tag.module);
      Command command{j, t, catalog::Stage::build, descriptor, implementation(tag, descriptor)};
      if (!command.descriptor || !command.module) {
        diagnostics.report(
            codes::kNotBuiltIn, tag.span,
            fmt::format("module \"{}\" has no implementation in this rigc", printable(tag.module)),
            suggest(tag.module, catalogue.modules()));
        good = false;
        continue;
      }
      const auto stage = catalog::parse_stage(tag.stage);
      command.stage = stage ? *stage : command.descriptor->stage;
      out.commands.push_back(command);
    }
  }
  if (!good) return std::nullopt;
  std::stable_sort(out.commands.begin(), out.commands.end(),
                   [](const Command& a, const Command& b) { return a.stage < b.stage; });
  return out;
}

std::optional<CommandList> only(CommandList commands, const tags::TaggedSkeleton& skeleton,
                                const std::vector<std::string>& groups, Diagnostics& diagnostics) {
  std::set<std::string> known;
  for (const tags::TaggedJoint& joint : skeleton.joints) known.insert(joint.ids.local);
  known.erase("");
  bool good = true;
  for (const std::string& group : groups) {
    if (known.count(group)) continue;
    diagnostics.report(codes::kNoSuchGroup, Place(),
                       fmt::format("there is no local group \"{}\"", printable(group)),
                       suggest(group, {known.begin(), known.end()}));
    good = false;
  }
  if (!good) return std::nullopt;
  std::erase_if(commands.commands, [&](const Command& command) {
    const std::string& local = skeleton.joints[command.joint].ids.local;
    return std::find(groups.begin(), groups.end(), local) == groups.end();
  });
  return commands;
}

std::optional<std::size_t> until(const CommandList& commands, const tags::TaggedSkeleton& skeleton,
                                 const std::string& name, Diagnostics& diagnostics) {
  std::vector<std::string> names;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < commands.commands.size(); ++i) {
    const tags::TaggedJoint& joint = skeleton.joints[commands.commands[i].joint];
    const std::string& id = tag_of(skeleton, commands.commands[i]).id;
    names.push_back(joint.name + "/" + id);
    const std::string labelled = joint.ids.local + "." + joint.ids.label + "/" + id;
    if (names.back() == name || labelled == name) found = i + 1;
  }
  if (!found) {
    diagnostics.report(codes::kNoSuchCommand, Place(),
                       fmt::format("no command \"{}\" is in the list", printable(name)),
                       suggest(name, names));
  }
  return found;
}

}  // namespace rigc::processor
