// SPDX-License-Identifier: MIT
// Edits of controls become commands of the module edit_shape, so that a rig file keeps them. Test:
// tests/templates/guides_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <map>

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

/// The joint of a group that a selector gives a number of; -1: it says something else.
int numbered_joint(const tags::TaggedSkeleton& skeleton, const selector::Choice& choice) {
  if (choice.indices.size() != 1 || choice.indices[0].all || choice.indices[0].last) return -1;
  std::vector<int> group;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    if (skeleton.joints[i].ids.local == choice.local) group.push_back(static_cast<int>(i));
  const selector::Index& index = choice.indices[0].first;
  const int count = static_cast<int>(group.size());
  using Kind = selector::Index::Kind;
  const int at = index.kind == Kind::start    ? 0
                 : index.kind == Kind::middle ? -1
                 : index.kind == Kind::end    ? count - 1
                 : index.number < 0           ? count + index.number
                                              : index.number;
  return at >= 0 && at < count ? group[static_cast<std::size_t>(at)] : -1;
}

/// One name for each control: a joint with a label of its own is called by it.
selector::Selector canonical(const tags::TaggedSkeleton& skeleton,
                             const std::vector<std::string>& names, selector::Selector control) {
  selector::Choice& choice = control.choices.front();
  const int joint = choice.label.empty() ? numbered_joint(skeleton, choice) : -1;
  if (joint < 0) return control;
  const auto at = static_cast<std::size_t>(joint);
  const std::string& label = skeleton.joints[at].ids.label;
  if (names[at] != choice.local + "." + label) return control;
  choice.label = label;
  choice.indices.clear();
  return control;
}

/// The same control on the other side, with the joint that a command about it stands on; -1: there
/// is none.
std::pair<selector::Selector, int> other_control(const tags::TaggedSkeleton& skeleton,
                                                 const std::vector<std::string>& names,
                                                 selector::Selector control, int holder,
                                                 Guides::Mirror mirror) {
  const tags::TaggedJoint& joint = skeleton.joints[static_cast<std::size_t>(holder)];
  const int other = joint.mirror.opposite.uid != 0 ? skeleton.find(joint.mirror.opposite) : -1;
  if (other < 0 || mirror == Guides::Mirror::none) return {std::move(control), -1};
  const auto side = [&](int index) {
    return to_template(skeleton.character, skeleton.world(static_cast<std::size_t>(index)).origin)
        .x;
  };
  const bool left = side(holder) > side(other);
  if (mirror != Guides::Mirror::both && left != (mirror == Guides::Mirror::left_to_right))
    return {std::move(control), -1};
  selector::Choice& choice = control.choices.front();
  const Identifiers& ids = skeleton.joints[static_cast<std::size_t>(other)].ids;
  choice.local = ids.local;
  if (choice.label == joint.ids.label) choice.label = ids.label;
  return {canonical(skeleton, names, std::move(control)), other};
}

/// What a file says of a control.
struct Wanted {
  int holder = -1;
  std::string control;
  const ControlEdit* edit = nullptr;  ///< without parameters: as the template has it
  selector::Selector selector;
};
using AllWanted = std::map<std::string, Wanted>;  ///< by command id

AllWanted read_wanted(const Guides& guides, const catalog::Catalogue& catalogue,
                      const tags::TaggedSkeleton& skeleton, const std::vector<std::string>& names,
                      Diagnostics& diagnostics) {
  AllWanted out;
  for (const ControlEdit& edit : guides.controls) {
    auto control = parse_control(edit, diagnostics);
    if (!control) continue;
    control = canonical(skeleton, names, *std::move(control));
    const selector::Choice& choice = control->choices.front();
    const int holder = holder_of(skeleton, choice);
    if (holder < 0 || !catalogue.find(choice.made->module)) {
      if (edit.with.empty()) continue;  // nothing is asked of it
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
    const std::string text = selector::print(*control);
    if (!out.emplace(id_of(text), Wanted{holder, text, &edit, *control}).second)
      diagnostics.report(
          codes::kGuideTwice, edit.span,
          fmt::format("{} is another name of a control above", printable(edit.control, 100)),
          "keep one of them");
  }
  return out;
}

/// What is said of one side is said of the other, where nothing else is.
void mirror_wanted(const Guides& guides, const tags::TaggedSkeleton& skeleton,
                   const std::vector<std::string>& names, AllWanted& wanted) {
  const AllWanted written = wanted;
  for (const auto& [id, one] : written) {
    const auto [other, holder] =
        other_control(skeleton, names, one.selector, one.holder, guides.mirror);
    if (holder < 0) continue;
    const std::string text = selector::print(other);
    const auto own = written.find(id_of(text));
    if (own == written.end() || (own->second.edit->with.empty() && !one.edit->with.empty()))
      wanted[id_of(text)] = {holder, text, one.edit, other};
  }
}

void add_command(tags::TaggedSkeleton& skeleton, const std::string& id, const Wanted& wanted) {
  const ControlEdit& edit = *wanted.edit;
  tags::CommandTag command;
  command.module = kModule;
  command.id = id;
  command.span = edit.span;
  Literal selector = Literal::of(wanted.control + "?");  // a feature that is off makes no control
  selector.span = edit.span;
  command.with.push_back({"control", edit.span, std::move(selector)});
  command.with.insert(command.with.end(), edit.with.begin(), edit.with.end());
  auto& commands = skeleton.joints[static_cast<std::size_t>(wanted.holder)].commands;
  const auto earlier = std::find_if(commands.begin(), commands.end(),
                                    [&](const tags::CommandTag& tag) { return tag.id == id; });
  if (earlier != commands.end())
    *earlier = std::move(command);
  else
    commands.push_back(std::move(command));
}

}  // namespace

std::vector<std::string> add_control_edits(const Guides& guides,
                                           const catalog::Catalogue& catalogue,
                                           tags::TaggedSkeleton& skeleton,
                                           Diagnostics& diagnostics) {
  const std::vector<std::string> names = guide_names(skeleton, nullptr);
  AllWanted wanted = read_wanted(guides, catalogue, skeleton, names, diagnostics);
  mirror_wanted(guides, skeleton, names, wanted);
  std::vector<std::string> put_back;
  for (const ControlEdit& edit : control_edits(skeleton))
    if (const auto found = wanted.find(id_of(edit.control));
        found != wanted.end() && found->second.edit->with.empty())
      put_back.push_back(edit.control);
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    std::erase_if(skeleton.joints[i].commands, [&](const tags::CommandTag& command) {
      const auto found = is_from_guides(command) ? wanted.find(command.id) : wanted.end();
      return found != wanted.end() &&
             (found->second.edit->with.empty() || found->second.holder != static_cast<int>(i));
    });
  std::vector<AllWanted::const_iterator> in_order;  // of the file
  for (auto one = wanted.cbegin(); one != wanted.cend(); ++one)
    if (!one->second.edit->with.empty()) in_order.push_back(one);
  std::stable_sort(in_order.begin(), in_order.end(),
                   [](const auto& a, const auto& b) { return a->second.edit < b->second.edit; });
  for (const auto& one : in_order) add_command(skeleton, one->first, one->second);
  return put_back;
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
