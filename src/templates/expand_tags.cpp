// SPDX-License-Identifier: MIT
// Tags while expanding: conditions, parameters put into arguments, groups renamed in selectors, the
// catalogues of features of all templates joined. Test: tests/templates/expand_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "selector/selector.h"
#include "templates/codes.h"
#include "templates/expander.h"

namespace rigc::templates {
namespace {

/// What a `side: signed` value is on the other side of the character: a number with the other sign,
/// [left, up, forward] with the other left, a word of a side or of a signed axis its opposite.
void turn_round(Literal& value) {
  if (value.kind == Literal::Kind::number) {
    if (value.number == 0) return;  // no -0
    const Span span = value.span;
    value = Literal::of(-value.number);
    value.span = span;
  } else if (value.kind == Literal::Kind::list && !value.items.empty()) {
    turn_round(value.items.front());
  } else if (value.kind == Literal::Kind::text) {
    std::string& word = value.text;
    if (word == "left" || word == "right")
      word = word == "left" ? "right" : "left";
    else if (word.starts_with('+') || word.starts_with('-'))
      word.front() = word.front() == '+' ? '-' : '+';
  }
}

}  // namespace

void Expander::add_tags(RawJoint& joint) {
  const Use& use = uses_[static_cast<std::size_t>(joint.use)];
  tags::TaggedJoint& tagged = joint.result.tagged;
  std::vector<int> feature_index;
  for (const Feature& feature : joint.source->features) {
    if (feature.condition && !holds(*feature.condition, use.environment)) {
      feature_index.push_back(kAbsent);
      continue;
    }
    feature_index.push_back(static_cast<int>(tagged.features.size()));
    tagged.features.push_back(feature.tag);
    joint.on_written.push_back(feature.on_written);
  }
  for (const Command& command : joint.source->commands) {
    if (command.condition && !holds(*command.condition, use.environment)) continue;
    const int written = command.tag.feature;
    const int feature = written < 0 ? -1 : feature_index[static_cast<std::size_t>(written)];
    if (feature != kAbsent) add_command(joint, command, feature);
  }
}

void Expander::add_command(RawJoint& joint, const Command& command, int feature) {
  const Use& use = uses_[static_cast<std::size_t>(joint.use)];
  tags::CommandTag tag = command.tag;
  tag.feature = feature;
  for (std::string& was : tag.was) was = earlier_holder(joint, was);
  const catalog::Descriptor* descriptor = catalogue_.find(tag.module);
  const int pinned = descriptor ? pinned_version(*use.source, *descriptor) : 0;
  for (tags::Argument& argument : tag.with) {
    const catalog::Parameter* parameter =
        descriptor ? declaration(*descriptor, argument.name) : nullptr;
    if (!parameter) continue;  // reported when the template was read
    bind_value(use, *descriptor, pinned, *parameter, argument);
    if (parameter->is_signed && use.mirrored) turn_round(argument.value);
    rename(joint.use, *parameter, argument.value);
  }
  // Defaults are what they are on every side and in every part.
  if (descriptor) add_earlier_defaults(*descriptor, pinned, tag);
  joint.result.tagged.commands.push_back(std::move(tag));
}

void Expander::bind_value(const Use& use, const catalog::Descriptor& descriptor, int pinned,
                          const catalog::Parameter& parameter, tags::Argument& argument) {
  if (use.environment.empty() || !substitute(argument.value, use.environment)) return;
  convert_value(descriptor, parameter, pinned, argument.value, diagnostics_);
  check_value(parameter, argument.value, diagnostics_);
}

/// Selectors in a part follow the part's name; naming the template's own global group says nothing.
void Expander::rename(int use, const catalog::Parameter& parameter, Literal& value) {
  if (value.kind == Literal::Kind::list) {
    for (Literal& item : value.items) rename(use, parameter, item);
    return;
  }
  if (value.kind != Literal::Kind::text) return;
  const Use& owner = uses_[static_cast<std::size_t>(use)];
  if (parameter.type == catalog::ParameterType::text && owner.part) {
    if (parameter.name == "local") value.text = final_group(use, value.text);
    if (parameter.name == "name") value.text = owner.prefix + value.text;
  }
  const bool expression = parameter.type == catalog::ParameterType::expression;
  if (!is_selector(parameter.type) && !expression) return;
  if (!owner.part && value.text.find(':') == std::string::npos) return;

  const auto rename_one = [&](selector::Selector& selector) {
    std::vector<std::pair<std::string, std::string>> groups;
    for (selector::Choice& choice : selector.choices) {
      if (choice.global == owner.source->global) choice.global.clear();
      if (choice.global.empty() && choice.scope == selector::Scope::group)
        groups.emplace_back(choice.local, final_group(use, choice.local));
    }
    selector::rename_groups(selector, groups);
  };
  if (expression) {
    auto parsed = selector::parse_expression(value.text, value.span, diagnostics_);
    if (!parsed) return;
    for (selector::Selector& selector : parsed->selectors) rename_one(selector);
    value.text = selector::print(*parsed);
  } else if (auto parsed = selector::parse(value.text, value.span, diagnostics_)) {
    rename_one(*parsed);
    value.text = selector::print(*parsed);
  }
}

/// A part without a catalogue of its own uses those of the templates around it.
void Expander::check_declared_outside(const Use& use, const tags::FeatureTag& tag) {
  const Use* nearest_catalogue = nullptr;
  for (int outer = use.outer; outer >= 0;) {
    const Use& around = uses_[static_cast<std::size_t>(outer)];
    if (around.source->find_feature(tag.name)) return;
    if (!nearest_catalogue && around.source->has_catalogue) nearest_catalogue = &around;
    outer = around.outer;
  }
  const auto place = std::pair(tag.span.file, std::pair(tag.span.line, tag.span.column));
  if (!nearest_catalogue || !undeclared_.insert(place).second) return;
  std::vector<std::string> names;
  for (const tags::FeatureDeclaration& feature : nearest_catalogue->source->features)
    names.push_back(feature.name);
  diagnostics_.report(codes::kUndeclaredFeature, tag.span,
                      fmt::format("feature \"{}\" is not in `features:` of {}", tag.name,
                                  nearest_catalogue->source->name),
                      suggest(tag.name, names));
}

/// One catalogue for the rig, outer templates first; then each tag gets its kind and default from
/// it.
void Expander::collect_features() {
  std::vector<tags::FeatureDeclaration>& all = skeleton_.features;
  const auto find = [&](const std::string& name) {
    return std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.name == name; });
  };
  for (const Use& use : uses_) {
    for (const tags::FeatureDeclaration& feature : use.source->features) {
      const auto known = find(feature.name);
      if (known == all.end()) {
        all.push_back(feature);
        continue;
      }
      if (known->kind != feature.kind)
        diagnostics_.report(
            codes::kFeatureKind, use.part ? use.part->span : use.source->span,
            fmt::format("the part declares the feature {} of kind \"{}\", not \"{}\"", feature.name,
                        feature.kind, known->kind));
      for (const std::string& name : feature.switches)
        if (std::find(known->switches.begin(), known->switches.end(), name) ==
            known->switches.end())
          known->switches.push_back(name);
    }
  }
  for (RawJoint& joint : joints_) {
    const Use& use = uses_[static_cast<std::size_t>(joint.use)];
    std::vector<tags::FeatureTag>& features = joint.result.tagged.features;
    for (std::size_t i = 0; i < features.size(); ++i) {
      tags::FeatureTag& tag = features[i];
      if (tag.name.empty()) continue;
      if (!use.source->has_catalogue) check_declared_outside(use, tag);
      auto known = find(tag.name);
      if (known == all.end()) {
        all.push_back({tag.name, tag.kind, {}, {}, true, {}});
        known = all.end() - 1;
      }
      if (tag.kind.empty()) tag.kind = known->kind;
      if (!joint.on_written[i]) tag.on = known->on;
      if (!tag.switch_name.empty() && std::find(known->switches.begin(), known->switches.end(),
                                                tag.switch_name) == known->switches.end())
        known->switches.push_back(tag.switch_name);
    }
  }
}

}  // namespace rigc::templates
