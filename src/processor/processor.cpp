// SPDX-License-Identifier: MIT
// Runs a command list, forwards and backwards. Test: tests/processor/processor_test.cpp
#include "processor/processor.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "base/trace.h"
#include "processor/codes.h"
#include "processor/forecast.h"
#include "selector/selector.h"

namespace rigc::processor {

using scene::NodeId;

Processor::Processor(const tags::TaggedSkeleton& skeleton, const CommandList& commands,
                     const catalog::Catalogue& catalogue, std::uint32_t rig,
                     tags::Geometry geometry)
    : skeleton_(skeleton),
      commands_(commands),
      catalogue_(catalogue),
      scene_(std::make_unique<scene::Scene>()),
      rig_(rig),
      geometry_(std::move(geometry)) {
  make_joints();
}

void Processor::make_joints() {
  scene::Journal journal;  // the skeleton is never undone
  scene::Edit edit(*scene_, journal, &index_);
  std::vector<NodeId> made;
  for (std::size_t j = 0; j < skeleton_.joints.size(); ++j) {
    const tags::TaggedJoint& joint = skeleton_.joints[j];
    scene::Node node;
    node.kind = scene::Kind::joint;
    node.name = joint.name;
    node.ids = joint.ids;
    node.identity.rig = rig_;
    node.identity.owner = joint.key;
    node.origin = {joint.span, joint.name, {}};
    if (joint.parent >= 0) node.parent = made[static_cast<std::size_t>(joint.parent)];
    const NodeId id = edit.make(std::move(node));
    edit.set({id, scene::transform::kTranslate}, joint.rest.translation);
    edit.set({id, scene::transform::kRotation}, joint.rest.rotation);
    edit.set({id, scene::transform::kScale}, joint.rest.scale);
    made.push_back(id);
  }
  // A skeleton stands at its first joint, also where a model does not stand at the origin.
  if (!made.empty()) {
    side_middle_ = math::dot(skeleton_.joints[0].rest.translation, skeleton_.character.left);
  }
}

traversal::Context Processor::context(std::size_t command) const {
  const tags::TaggedJoint& joint = skeleton_.joints[commands_.commands[command].joint];
  return {*scene_, index_, skeleton_.global, index_.joint(joint.key), {}};
}

bool Processor::construct(std::size_t at, scene::Edit& edit, Diagnostics& diagnostics) {
  const Command& command = commands_.commands[at];
  const tags::CommandTag& tag = tag_of(skeleton_, command);
  const trace::Span span(tag.id, tag.module, "joint", skeleton_.joints[command.joint].name);
  traversal::Context where = context(at);
  where.forecast = [&](const selector::Choice& choice) {
    return forecast({skeleton_, commands_, catalogue_, at, diagnostics.sources()}, choice, where);
  };
  const std::size_t errors = diagnostics.errors();
  auto bound = modules::bind(tag, *command.descriptor, skeleton_.character.unit, where, diagnostics,
                             command.base);
  if (!bound) return false;
  if (const auto* skipped = std::get_if<modules::Skipped>(&*bound)) {
    report_skipped(at, skipped->parameter, diagnostics);
    skipped_.push_back(true);
    return true;
  }
  const modules::Builder::Job job{skeleton_, catalogue_,    index_,
                                  tag,       command.joint, static_cast<std::uint32_t>(at),
                                  geometry_, side_middle_,  diagnostics};
  modules::Builder builder(job, std::move(std::get<modules::Parameters>(*bound)), edit);
  command.module->construct(builder);
  if (builder.failed() || diagnostics.errors() > errors) return false;
  skipped_.push_back(false);
  return true;
}

/// The feature that is off and whose command would make what an argument names; of a list, the
/// first such.
std::optional<std::string> Processor::feature_off_for(std::size_t at, const Literal* argument,
                                                      const Diagnostics& diagnostics) {
  if (!argument) return std::nullopt;
  for (const Literal& item : argument->items)
    if (auto off = feature_off_for(at, &item, diagnostics)) return off;
  if (argument->kind != Literal::Kind::text) return std::nullopt;
  Diagnostics quiet;
  const auto selector = selector::parse(argument->text, argument->span, quiet);
  const Outlook outlook{skeleton_, commands_, catalogue_, at, diagnostics.sources()};
  return selector ? missing_feature(outlook, *selector, context(at)) : std::nullopt;
}

/// Where the reason is a feature that somebody turned off, all that it stops is told at once; what
/// is off by default misses nobody.
void Processor::report_skipped(std::size_t at, const std::string& parameter,
                               Diagnostics& diagnostics) {
  const Command& command = commands_.commands[at];
  const tags::TaggedJoint& joint = skeleton_.joints[command.joint];
  const tags::CommandTag& tag = tag_of(skeleton_, command);
  const auto off = feature_off_for(at, tag.find(parameter), diagnostics);
  if (!off) {
    diagnostics.report(
        codes::kSkipped, tag.span,
        fmt::format("command \"{}\" is skipped: \"{}\" finds nothing", tag.id, parameter));
    return;
  }
  const bool by_default =
      std::any_of(skeleton_.features.begin(), skeleton_.features.end(),
                  [&](const auto& feature) { return feature.name == *off && !feature.on; });
  if (by_default) return;
  const std::string& own =
      tag.feature < 0 ? tag.id : joint.features[static_cast<std::size_t>(tag.feature)].name;
  std::vector<std::string>& names = idle_[*off];
  const std::string& name = own.empty() ? tag.id : own;
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void Processor::report_idle(Diagnostics& diagnostics) {
  for (const auto& [off, names] : idle_)
    diagnostics.report(codes::kIdleFeatures, Place(),
                       fmt::format("feature \"{}\" is off: what works on it is left out of {}", off,
                                   join(names, ", ")));
  idle_.clear();
}

bool Processor::step(Diagnostics& diagnostics) {
  const std::size_t at = position();
  if (at == commands_.commands.size()) return true;
  scene::Journal journal;
  scene::Edit edit(*scene_, journal, &index_);
  if (!construct(at, edit, diagnostics)) {
    scene::Edit::undo(*scene_, journal, &index_);
    return false;
  }
  journals_.push_back(std::move(journal));
  if (position() == commands_.commands.size()) report_idle(diagnostics);
  return true;
}

bool Processor::step_back() {
  if (journals_.empty()) return false;
  scene::Edit::undo(*scene_, journals_.back(), &index_);
  journals_.pop_back();
  skipped_.pop_back();
  return true;
}

bool Processor::step_joint(Diagnostics& diagnostics) {
  const std::size_t end = commands_.commands.size();
  if (position() == end) return true;
  const std::size_t joint = commands_.commands[position()].joint;
  while (position() < end && commands_.commands[position()].joint == joint) {
    if (!step(diagnostics)) return false;
  }
  return true;
}

bool Processor::step_joint_back() {
  if (position() == 0) return false;
  const std::size_t joint = commands_.commands[position() - 1].joint;
  while (position() > 0 && commands_.commands[position() - 1].joint == joint) step_back();
  return true;
}

bool Processor::go_to(std::size_t target, Diagnostics& diagnostics) {
  while (position() > target) step_back();
  while (position() < target) {
    if (!step(diagnostics)) return false;
  }
  report_idle(diagnostics);
  return true;
}

std::vector<Processor::ResolvedArgument> Processor::resolved(std::size_t at) const {
  using catalog::ParameterType;
  std::vector<ResolvedArgument> out;
  const Command& command = commands_.commands[at];
  const tags::CommandTag& tag = tag_of(skeleton_, command);
  for (const catalog::Parameter& parameter : command.descriptor->parameters) {
    const bool selects =
        parameter.type == ParameterType::node || parameter.type == ParameterType::nodes ||
        parameter.type == ParameterType::plug || parameter.type == ParameterType::plugs;
    const Literal* value = tag.find(parameter.name);
    if (!value && parameter.default_value) value = &*parameter.default_value;
    if (!selects || !value) continue;
    const std::vector<Literal> one{*value};
    const std::vector<Literal>& items = value->kind == Literal::Kind::list ? value->items : one;
    for (const Literal& item : items) {
      Diagnostics quiet;
      const auto selector = selector::parse(item.text, item.span, quiet);
      const auto found =
          selector ? traversal::resolve(*selector, context(at), quiet) : std::nullopt;
      ResolvedArgument argument{parameter.name, item.text, {}};
      if (found) {
        for (NodeId id : found->nodes) argument.found.push_back(traversal::describe(*scene_, id));
      }
      out.push_back(std::move(argument));
    }
  }
  return out;
}

}  // namespace rigc::processor
