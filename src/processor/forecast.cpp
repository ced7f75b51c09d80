// SPDX-License-Identifier: MIT
// Forecasts: a later or switched-off command whose nodes the selector would find.
// Test: tests/processor/forecast_test.cpp
#include "processor/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"

namespace rigc::processor {
namespace {

using catalog::ParameterType;
using scene::NodeId;

/// Nodes that a selector finds now as seen from a joint, or none.
std::vector<NodeId> found_now(const selector::Selector& selector, const traversal::Context& context,
                              NodeId self) {
  Diagnostics quiet;
  const traversal::Context there{context.scene, context.index, context.global, self, {}};
  const auto found = traversal::resolve(selector, there, quiet);
  return found ? found->nodes : std::vector<NodeId>{};
}

class Forecaster {
 public:
  Forecaster(const selector::Choice& choice, const traversal::Context& context)
      : choice_(choice), context_(context) {
    selector::Choice scope = choice;
    scope.made.reset();
    scope.kind = scope.attribute = scope.component = {};
    scope_ = found_now({{scope}, false, {}}, context, context.self);
  }

  bool would_make(const tags::TaggedJoint& holder, const tags::CommandTag& tag,
                  const catalog::Descriptor* descriptor) const {
    if (!descriptor || !descriptor->makes_nodes() || !module_fits(tag, *descriptor)) return false;
    const Literal* local = tag.find("local");
    const Literal* label = tag.find("label");
    if (local || label) {
      if (choice_.scope != selector::Scope::group) return false;
      return choice_.local == (local ? local->text : holder.ids.local) &&
             (choice_.label.empty() || choice_.label == (label ? label->text : holder.ids.label));
    }
    if (in_scope(context_.index.joint(holder.key))) return true;
    const std::vector<NodeId> others = joint_arguments(holder, tag, *descriptor);
    return std::any_of(others.begin(), others.end(), [this](NodeId id) { return in_scope(id); });
  }

 private:
  bool module_fits(const tags::CommandTag& tag, const catalog::Descriptor& descriptor) const {
    if (!choice_.made) return true;
    const selector::Made& made = *choice_.made;
    if (made.module != "*" && made.module != tag.module) return false;
    if (!made.id.empty() && made.id != tag.id) return false;
    return made.role.empty() ||
           std::any_of(descriptor.creates.begin(), descriptor.creates.end(),
                       [&](const catalog::Creates& row) { return row.role == made.role; });
  }

  bool in_scope(NodeId joint) const {
    return std::find(scope_.begin(), scope_.end(), joint) != scope_.end();
  }

  /// The joints that a command's parameters name: it may make nodes for them.
  std::vector<NodeId> joint_arguments(const tags::TaggedJoint& holder, const tags::CommandTag& tag,
                                      const catalog::Descriptor& descriptor) const {
    const NodeId self = context_.index.joint(holder.key);
    std::vector<NodeId> joints;
    for (const catalog::Parameter& parameter : descriptor.parameters) {
      const Literal* value = tag.find(parameter.name);
      if (parameter.kind != "joint" || !value) continue;
      const std::vector<Literal> one{*value};
      for (const Literal& item : value->kind == Literal::Kind::list ? value->items : one) {
        Diagnostics quiet;
        const auto selector = selector::parse(item.text, item.span, quiet);
        if (!selector) continue;
        const auto found = found_now(*selector, context_, self);
        joints.insert(joints.end(), found.begin(), found.end());
      }
    }
    return joints;
  }

  const selector::Choice& choice_;
  const traversal::Context& context_;
  std::vector<NodeId> scope_;
};

std::string made_by(const tags::TaggedJoint& joint, const tags::CommandTag& tag,
                    const Sources& sources, std::string_view why_not) {
  return fmt::format("made by \"{}\" on joint \"{}\", which {}, {}:{}", tag.id,
                     printable(joint.name), why_not,
                     printable(std::string(sources.name(tag.span.file))), tag.span.line);
}

struct Tagged {
  const tags::TaggedJoint& joint;
  const tags::CommandTag& tag;
};

/// The first command outside the list, because it or its feature is off, that would make it.
std::optional<Tagged> switched_off(const Outlook& outlook, const Forecaster& forecaster) {
  std::set<std::pair<std::size_t, std::size_t>> listed;
  for (const Command& command : outlook.commands.commands) {
    listed.emplace(command.joint, command.tag);
  }
  for (std::size_t j = 0; j < outlook.skeleton.joints.size(); ++j) {
    const tags::TaggedJoint& joint = outlook.skeleton.joints[j];
    for (std::size_t t = 0; t < joint.commands.size(); ++t) {
      const tags::CommandTag& tag = joint.commands[t];
      if (listed.count({j, t})) continue;
      if (!forecaster.would_make(joint, tag, outlook.catalogue.find(tag.module))) continue;
      return Tagged{joint, tag};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> missing_feature(const Outlook& outlook,
                                           const selector::Selector& selector,
                                           const traversal::Context& context) {
  for (const selector::Choice& choice : selector.choices) {
    if (!choice.made) continue;
    const auto off = switched_off(outlook, Forecaster(choice, context));
    if (!off || off->tag.feature < 0) continue;
    const auto& feature = off->joint.features[static_cast<std::size_t>(off->tag.feature)];
    if (!feature.on && !feature.name.empty()) return feature.name;
  }
  return std::nullopt;
}

std::string forecast(const Outlook& outlook, const selector::Choice& choice,
                     const traversal::Context& context) {
  if (!choice.made && choice.label.empty()) return {};
  const Forecaster forecaster(choice, context);
  const auto& commands = outlook.commands.commands;
  for (std::size_t later = outlook.command + 1; later < commands.size(); ++later) {
    const tags::TaggedJoint& joint = outlook.skeleton.joints[commands[later].joint];
    const tags::CommandTag& tag = tag_of(outlook.skeleton, commands[later]);
    if (!forecaster.would_make(joint, tag, commands[later].descriptor)) continue;
    return made_by(joint, tag, outlook.sources, "runs later") +
           "; give that command an earlier stage or this one a later";
  }
  const auto off = switched_off(outlook, forecaster);
  return off ? made_by(off->joint, off->tag, outlook.sources, "is switched off") : std::string();
}

}  // namespace rigc::processor
