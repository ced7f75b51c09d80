// SPDX-License-Identifier: MIT
// Edits of controls become commands of the module edit_shape, so that a rig file keeps them. Test:
// tests/templates/guides_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "selector/selector.h"
#include "templates/codes.h"
#include "templates/guides.h"

namespace rigc::templates {
namespace {

constexpr const char* kModule = "edit_shape";
constexpr std::string_view kIdBegin = "guides-";

bool is_from_guides(const tags::CommandTag& command) {
  return command.module == kModule && starts_with(command.id, kIdBegin);
}

/// A stable id: what the control is, in letters that ids may have.
std::string id_of(const std::string& control) {
  std::string id(kIdBegin);
  for (const char c : control) id += is_name(std::string("a") + c) ? c : '-';
  return id;
}

/// A selector of one control made by a command; what it cannot mean is reported.
std::optional<selector::Selector> parse_control(const ControlEdit& edit, Diagnostics& diagnostics) {
  auto parsed = selector::parse(edit.control, edit.span, diagnostics);
  if (!parsed) return std::nullopt;
  const selector::Choice& choice = parsed->choices.front();
  const bool good = parsed->choices.size() == 1 && choice.scope == selector::Scope::group &&
                    choice.global.empty() && choice.attribute.empty() && choice.made;
  if (good) return parsed;
  diagnostics.report(codes::kBadGuide, edit.span,
                     fmt::format("\"{}\" does not say which control of a joint or limb is meant",
                                 printable(edit.control, 100)),
                     "write GROUP.LABEL/MODULE or GROUP.LABEL/MODULE.ROLE");
  return std::nullopt;
}

/// The joint that a command about a control stands on; -1: there is none.
int holder_of(const tags::TaggedSkeleton& skeleton, const selector::Choice& choice) {
  int first = -1;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const Identifiers& ids = skeleton.joints[i].ids;
    if (ids.local != choice.local) continue;
    if (first < 0) first = static_cast<int>(i);
    if (ids.label == choice.label) return static_cast<int>(i);
  }
  return first;
}

/// The same control on the other side; empty where there is none.
std::string other_control(const tags::TaggedSkeleton& skeleton, selector::Selector control,
                          int holder, Guides::Mirror mirror) {
  const tags::TaggedJoint& joint = skeleton.joints[static_cast<std::size_t>(holder)];
  const int other = joint.mirror.opposite.uid != 0 ? skeleton.find(joint.mirror.opposite) : -1;
  if (other < 0 || mirror == Guides::Mirror::none) return {};
  const auto side = [&](int index) {
    return to_template(skeleton.character, skeleton.world(static_cast<std::size_t>(index)).origin)
        .x;
  };
  const bool left = side(holder) > side(other);
  if (mirror != Guides::Mirror::both && left != (mirror == Guides::Mirror::left_to_right))
    return {};
  selector::Choice& choice = control.choices.front();
  const Identifiers& ids = skeleton.joints[static_cast<std::size_t>(other)].ids;
  choice.local = ids.local;
  if (choice.label == joint.ids.label) choice.label = ids.label;
  return selector::print(control);
}

void add_command(tags::TaggedSkeleton& skeleton, int holder, const std::string& control,
                 const ControlEdit& edit) {
  tags::CommandTag command;
  command.module = kModule;
  command.id = id_of(control);
  command.span = edit.span;
  Literal selector = Literal::of(control + "?");  // a feature that is off makes no control
  selector.span = edit.span;
  command.with.push_back({"control", edit.span, std::move(selector)});
  command.with.insert(command.with.end(), edit.with.begin(), edit.with.end());
  skeleton.joints[static_cast<std::size_t>(holder)].commands.push_back(std::move(command));
}

void drop_commands(tags::TaggedSkeleton& skeleton) {
  for (tags::TaggedJoint& joint : skeleton.joints) std::erase_if(joint.commands, is_from_guides);
}

}  // namespace

void add_control_edits(const Guides& guides, const catalog::Catalogue& catalogue,
                       tags::TaggedSkeleton& skeleton, Diagnostics& diagnostics) {
  drop_commands(skeleton);
  std::vector<std::string> written;
  for (const ControlEdit& edit : guides.controls) written.push_back(edit.control);
  for (const ControlEdit& edit : guides.controls) {
    const auto control = parse_control(edit, diagnostics);
    if (!control) continue;
    const selector::Choice& choice = control->choices.front();
    const int holder = holder_of(skeleton, choice);
    if (holder < 0 || !catalogue.find(choice.made->module)) {
      std::vector<std::string> groups;
      for (const tags::TaggedJoint& joint : skeleton.joints)
        if (std::find(groups.begin(), groups.end(), joint.ids.local) == groups.end())
          groups.push_back(joint.ids.local);
      diagnostics.report(codes::kUnknownGuide, edit.span,
                         fmt::format("there is no control \"{}\"", printable(edit.control, 100)),
                         holder < 0 ? suggest(choice.local, groups)
                                    : suggest(choice.made->module, catalogue.modules()));
      continue;
    }
    add_command(skeleton, holder, selector::print(*control), edit);
    const std::string other = other_control(skeleton, *control, holder, guides.mirror);
    if (other.empty() || std::find(written.begin(), written.end(), other) != written.end())
      continue;
    const int other_holder =
        skeleton.find(skeleton.joints[static_cast<std::size_t>(holder)].mirror.opposite);
    add_command(skeleton, other_holder, other, edit);
  }
}

std::vector<ControlEdit> control_edits(const tags::TaggedSkeleton& skeleton) {
  std::vector<ControlEdit> out;
  for (const tags::TaggedJoint& joint : skeleton.joints) {
    for (const tags::CommandTag& command : joint.commands) {
      const Literal* control = command.find("control");
      if (!is_from_guides(command) || !control) continue;
      ControlEdit edit;
      edit.control = control->text;
      if (ends_with(edit.control, "?")) edit.control.pop_back();
      for (const tags::Argument& argument : command.with)
        if (argument.name != "control") edit.with.push_back(argument);
      out.push_back(std::move(edit));
    }
  }
  return out;
}

void keep_control_edits(tags::TaggedSkeleton& fresh, const tags::TaggedSkeleton& old,
                        const std::vector<int>& counterparts) {
  for (std::size_t i = 0; i < fresh.joints.size(); ++i) {
    if (counterparts[i] < 0) continue;
    for (tags::CommandTag command :
         old.joints[static_cast<std::size_t>(counterparts[i])].commands) {
      if (!is_from_guides(command)) continue;
      command.span = {};
      command.feature = -1;
      for (tags::Argument& argument : command.with) argument.span = argument.value.span = {};
      fresh.joints[i].commands.push_back(std::move(command));
    }
  }
}

}  // namespace rigc::templates
