// SPDX-License-Identifier: MIT
// Reads the `tags:` of a joint: commands and the features that hold them.
// Test: tests/templates/read_test.cpp
#include <fmt/format.h>

#include <set>

#include "base/text.h"
#include "catalog/descriptor.h"
#include "templates/arguments.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/reader.h"

namespace rigc::templates {
namespace {

void read_with(Reader& reader, const yaml::Node& node, tags::CommandTag& tag) {
  if (!node.is_map()) {
    if (!node.is_null()) yaml::check_keys(node, {}, "with", reader.diagnostics);
    return;
  }
  tag.with.reserve(node.entries.size());
  for (const yaml::Node::Entry& entry : node.entries) {
    auto value = literal_from(entry.value, reader.diagnostics);
    if (value) tag.with.push_back({entry.key, entry.key_span, std::move(*value)});
  }
}

/// `was: [joint/command]`, also a single one.
void read_command_was(Reader& reader, const yaml::Node& node, tags::CommandTag& tag) {
  const auto add = [&](const yaml::Node& item) {
    const auto text = yaml::as_text(item, "was", reader.diagnostics);
    if (!text) return;
    const auto parts = split(*text, '/');
    const bool joint = is_name(parts[0]) || parse_hex16(parts[0]);
    if (parts.size() == 2 && joint && is_name(parts[1]))
      tag.was.push_back(*text);
    else
      reader.error(codes::kNotAllowed, item.span,
                   fmt::format("was: \"{}\" is not JOINT/COMMAND", printable(*text, 60)),
                   "write the joint that held the command and the command's id: elbow/main");
  };
  if (!node.is_sequence()) return add(node);
  for (const yaml::Node& item : node.items) add(item);
}

void read_stage(Reader& reader, const yaml::Node& node, tags::CommandTag& tag) {
  const auto text = yaml::as_text(node, "stage", reader.diagnostics);
  if (!text) return;
  if (catalog::parse_stage(*text))
    tag.stage = *text;
  else
    reader.error(codes::kUnknownWord, node.span,
                 fmt::format("stage: \"{}\" is no stage", printable(*text, 60)),
                 suggest(*text, command_format().words("stage")));
}

void read_command(Reader& reader, const yaml::Node& node, int feature, Joint& joint) {
  yaml::check_section(node, command_format(), reader.diagnostics);
  Command command;
  tags::CommandTag& tag = command.tag;
  const yaml::Node& module_node = *node.find("command");
  const auto module_name = yaml::as_name(module_node, "command", reader.diagnostics);
  tag.module = module_name.value_or("");
  tag.span = module_node.span;
  tag.feature = feature;
  tag.id = tag.module;
  if (const yaml::Node* id = node.find("id"))
    tag.id = yaml::as_name(*id, "id", reader.diagnostics).value_or("");
  if (const yaml::Node* comment = node.find("comment"))
    tag.comment = yaml::as_text(*comment, "comment", reader.diagnostics).value_or("");
  if (const yaml::Node* stage = node.find("stage")) read_stage(reader, *stage, tag);
  if (const yaml::Node* on = node.find("on"))
    tag.on = yaml::as_bool(*on, "on", reader.diagnostics).value_or(true);
  if (const yaml::Node* was = node.find("was")) read_command_was(reader, *was, tag);
  if (const yaml::Node* condition = node.find("if"))
    command.condition = reader.condition(*condition);
  if (const yaml::Node* with = node.find("with")) read_with(reader, *with, tag);
  if (module_name) {
    if (const catalog::Descriptor* descriptor = reader.catalogue.find(*module_name))
      check_arguments(*descriptor, reader.out, tag, reader.diagnostics);
    else
      reader.error(codes::kUnknownModule, module_node.span,
                   fmt::format("there is no module \"{}\"", *module_name),
                   suggest(*module_name, reader.catalogue.modules()));
  }
  joint.commands.push_back(std::move(command));
}

/// The declaration of a named feature; reports what the catalogue does not have.
void check_declaration(Reader& reader, const yaml::Node& node, tags::FeatureTag& tag) {
  const Template& owner = reader.out;
  const tags::FeatureDeclaration* declared = owner.find_feature(tag.name);
  if (!declared) {
    if (!owner.has_catalogue) return;
    std::vector<std::string> names;
    for (const tags::FeatureDeclaration& feature : owner.features) names.push_back(feature.name);
    reader.error(codes::kUndeclaredFeature, tag.span,
                 fmt::format("feature \"{}\" is not in `features:`", tag.name),
                 suggest(tag.name, names));
    return;
  }
  if (!tag.kind.empty() && tag.kind != declared->kind)
    reader.error(
        codes::kFeatureKind, node.find("kind")->span,
        fmt::format("{} is declared as a feature of kind \"{}\"", tag.name, declared->kind));
  tag.kind = declared->kind;
  if (tag.switch_name.empty()) return;
  for (const std::string& name : declared->switches)
    if (name == tag.switch_name) return;
  reader.error(codes::kUndeclaredSwitch, node.find("switch")->span,
               fmt::format("the feature {} has no switch \"{}\"", tag.name, tag.switch_name),
               suggest(tag.switch_name, declared->switches));
}

int read_feature_tag(Reader& reader, const yaml::Node& node, Joint& joint) {
  yaml::check_section(node, feature_format(), reader.diagnostics);
  Feature feature;
  tags::FeatureTag& tag = feature.tag;
  tag.span = node.span;
  if (const yaml::Node* kind = node.find("kind"))
    tag.kind = yaml::as_name(*kind, "kind", reader.diagnostics).value_or("");
  if (const yaml::Node* name = node.find("switch"))
    tag.switch_name = yaml::as_name(*name, "switch", reader.diagnostics).value_or("");
  if (const yaml::Node* on = node.find("on")) {
    tag.on = yaml::as_bool(*on, "on", reader.diagnostics).value_or(true);
    feature.on_written = true;
  }
  if (const yaml::Node* condition = node.find("if"))
    feature.condition = reader.condition(*condition);
  if (const yaml::Node* name = node.find("feature"); name && !name->is_null()) {
    tag.span = name->span;
    tag.name = yaml::as_name(*name, "feature", reader.diagnostics).value_or("");
    if (!tag.name.empty()) check_declaration(reader, node, tag);
  }
  joint.features.push_back(std::move(feature));
  return static_cast<int>(joint.features.size()) - 1;
}

void read_feature(Reader& reader, const yaml::Node& node, Joint& joint) {
  const int index = read_feature_tag(reader, node, joint);
  const yaml::Node* commands = reader.required(node, "commands", "a feature");
  if (!commands || commands->is_null()) return;
  if (!commands->is_sequence()) {
    reader.error(codes::kNotATag, commands->span, "`commands` is a list of `- command: MODULE`");
    return;
  }
  for (const yaml::Node& item : commands->items) {
    if (item.is_map() && item.find("command"))
      read_command(reader, item, index, joint);
    else
      reader.error(codes::kNotATag, item.span, "inside a feature there are only commands",
                   "write `- command: MODULE`");
  }
}

void check_ids(Reader& reader, const Joint& joint) {
  std::set<std::string_view> ids;
  for (const Command& command : joint.commands) {
    const tags::CommandTag& tag = command.tag;
    if (tag.id.empty() || ids.insert(tag.id).second) continue;
    reader.error(codes::kCommandIdTwice, tag.span,
                 fmt::format("joint {} has two commands with the id \"{}\"", joint.name, tag.id),
                 fmt::format("give this one an id of its own: `id: {}_2`", tag.id));
  }
}

}  // namespace

void read_tags(Reader& reader, const yaml::Node& node, Joint& joint) {
  if (node.is_null()) return;
  if (!node.is_sequence()) {
    reader.error(codes::kNotATag, node.span, "`tags` is a list", "write `- command: MODULE`");
    return;
  }
  for (const yaml::Node& item : node.items) {
    if (item.is_map() && item.find("command"))
      read_command(reader, item, -1, joint);
    else if (item.is_map() && (item.find("feature") || item.find("commands")))
      read_feature(reader, item, joint);
    else
      reader.error(codes::kNotATag, item.span, "a tag is a command or a feature",
                   "write `- command: MODULE`, or `- feature: NAME` with `commands:`");
  }
  check_ids(reader, joint);
}

}  // namespace rigc::templates
