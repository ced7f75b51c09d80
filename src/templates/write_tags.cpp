// SPDX-License-Identifier: MIT
// The tags of a joint as text. Test: tests/templates/write_test.cpp
#include "templates/write_tags.h"

#include <algorithm>

#include "base/text.h"
#include "templates/arguments.h"
#include "templates/yaml_text.h"

namespace rigc::templates {
namespace {

class TagText {
 public:
  TagText(const tags::TaggedJoint& joint, const catalog::Catalogue& catalogue,
          const std::map<std::string, bool>& defaults, std::size_t columns)
      : joint_(joint), catalogue_(catalogue), defaults_(defaults), columns_(columns) {}

  std::string run() {
    for (std::size_t i = 0; i < joint_.commands.size(); ++i) {
      const int feature = group_of(i);
      const bool inside = feature >= 0;
      if (inside && (i == 0 || group_of(i - 1) != feature)) open(feature);
      command(joint_.commands[i], inside ? 10 : 6);
    }
    return std::move(out_);
  }

 private:
  void line(std::size_t indent, const std::string& text) {
    out_.append(indent, ' ');
    out_ += text + '\n';
  }

  /// A feature without a name that is on only puts commands together.
  int group_of(std::size_t command) const {
    const int index = joint_.commands[command].feature;
    if (index < 0) return -1;
    const tags::FeatureTag& tag = joint_.features[static_cast<std::size_t>(index)];
    return tag.name.empty() && tag.on ? -1 : index;
  }

  void open(int index) {
    const tags::FeatureTag& tag = joint_.features[static_cast<std::size_t>(index)];
    const std::size_t begin = out_.size();
    if (!tag.name.empty()) line(8, "feature: " + yaml_text(tag.name));
    if (!tag.switch_name.empty()) line(8, "switch: " + yaml_text(tag.switch_name));
    const auto known = defaults_.find(tag.name);
    if (tag.on != (known == defaults_.end() || known->second))
      line(8, tag.on ? "on: true" : "on: false");
    line(8, "commands:");
    out_[begin + 6] = '-';
  }

  void command(const tags::CommandTag& tag, std::size_t indent) {
    line(indent, "- command: " + yaml_text(tag.module));
    indent += 2;
    if (tag.id != tag.module) line(indent, "id: " + yaml_text(tag.id));
    if (!tag.comment.empty()) line(indent, "comment: " + yaml_text(tag.comment));
    if (!tag.stage.empty()) line(indent, "stage: " + yaml_text(tag.stage));
    if (!tag.on) line(indent, "on: false");
    if (!tag.was.empty()) was(tag, indent);
    arguments(tag, indent);
  }

  /// Tags have joint keys, templates uids; only first joints of chains hold commands.
  void was(const tags::CommandTag& tag, std::size_t indent) {
    std::vector<std::string> holders;
    for (const std::string& holder : tag.was) {
      const std::size_t slash = holder.find('/');
      const auto key = parse_joint_key(holder.substr(0, slash));
      if (key && slash != std::string::npos)
        holders.push_back(hex16(key->uid) + holder.substr(slash));
    }
    if (!holders.empty()) line(indent, "was: [" + join(holders, ", ") + "]");
  }

  /// What the descriptor says anyway needs no saying; a default that changed once does.
  bool is_default(const catalog::Descriptor& descriptor, const tags::Argument& argument) const {
    const catalog::Parameter* parameter = descriptor.find(argument.name);
    if (!parameter || !parameter->default_value || argument.value != *parameter->default_value)
      return false;
    return std::none_of(descriptor.changes.begin(), descriptor.changes.end(),
                        [&](const catalog::Change& change) {
                          return change.parameter == argument.name && change.default_was;
                        });
  }

  void arguments(const tags::CommandTag& tag, std::size_t indent) {
    const catalog::Descriptor* descriptor = catalogue_.find(tag.module);
    std::vector<std::string> items;
    std::size_t width = indent + std::string_view("with: {}").size();
    for (const tags::Argument& argument : tag.with) {
      if (descriptor && is_default(*descriptor, argument)) continue;
      items.push_back(yaml_text(argument.name) + ": " + yaml_text(argument.value));
      width += items.back().size() + 2;
    }
    if (items.empty()) return;
    if (width <= columns_ + 2) return line(indent, "with: {" + join(items, ", ") + "}");
    line(indent, "with:");
    for (const std::string& item : items) line(indent + 2, item);
  }

  const tags::TaggedJoint& joint_;
  const catalog::Catalogue& catalogue_;
  const std::map<std::string, bool>& defaults_;
  const std::size_t columns_;
  std::string out_;
};

}  // namespace

std::map<std::string, bool> feature_defaults(const tags::TaggedSkeleton& skeleton) {
  std::map<std::string, bool> defaults;
  std::map<std::string, std::pair<bool, bool>> seen;  // on, off
  for (const tags::TaggedJoint& joint : skeleton.joints)
    for (const tags::FeatureTag& tag : joint.features)
      (tag.on ? seen[tag.name].first : seen[tag.name].second) = true;
  for (const tags::FeatureDeclaration& feature : skeleton.features) {
    const auto found = seen.find(feature.name);
    const bool one = found != seen.end() && found->second.first != found->second.second;
    defaults[feature.name] = one ? found->second.first : feature.on;
  }
  return defaults;
}

std::string tags_text(const tags::TaggedJoint& joint, const catalog::Catalogue& catalogue,
                      const std::map<std::string, bool>& defaults, std::size_t columns) {
  if (joint.commands.empty()) return {};
  return "    tags:\n" + TagText(joint, catalogue, defaults, columns).run();
}

}  // namespace rigc::templates
