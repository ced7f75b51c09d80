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

/// Whether a descriptor declares what the constructor of another module asks for.
bool check_fits(const catalog::Descriptor& descriptor, const catalog::Descriptor& base,
                const Span& span, Diagnostics& diagnostics) {
  bool good = true;
  for (const catalog::Parameter& needed : base.parameters) {
    const catalog::Parameter* own = descriptor.find(needed.name);
    if (own ? own->type == needed.type : !needed.required) continue;
    diagnostics.report(
        codes::kDoesNotFit, span,
        fmt::format("module \"{}\" is implemented by \"{}\", which takes \"{}\" "
                    "of type {}",
                    descriptor.module, base.module, needed.name, name_of(needed.type)),
        fmt::format("declare it in {}.yaml", descriptor.module));
    good = false;
  }
  return good;
}

/// The command with its constructor: the module's own, or that of the module that its descriptor
/// names.
std::optional<Command> make_command(const tags::CommandTag& tag,
                                    const catalog::Catalogue& catalogue, Diagnostics& diagnostics) {
  Command command;
  command.descriptor = catalogue.find(tag.module);
  if (command.descriptor) {
    const bool own = command.descriptor->implementation == "builtin";
    const std::string& name = own ? tag.module : command.descriptor->implementation;
    command.module = modules::find(name);
    if (!own) command.base = catalogue.find(name);
  }
  if (!command.module) {
    diagnostics.report(
        codes::kNotBuiltIn, tag.span,
        fmt::format("module \"{}\" has no implementation in this rigc", printable(tag.module)),
        suggest(tag.module, catalogue.modules()));
    return std::nullopt;
  }
  if (command.base && !check_fits(*command.descriptor, *command.base, tag.span, diagnostics)) {
    return std::nullopt;
  }
  const auto stage = catalog::parse_stage(tag.stage);
  command.stage = stage ? *stage : command.descriptor->stage;
  return command;
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
      auto command = make_command(tag, catalogue, diagnostics);
      good = good && command;
      if (!command) continue;
      command->joint = j;
      command->tag = t;
      out.commands.push_back(*command);
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
