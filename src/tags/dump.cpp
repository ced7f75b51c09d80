// SPDX-License-Identifier: MIT
// A tagged skeleton as text. Test: tests/tags/tags_test.cpp
#include "tags/dump.h"

#include <fmt/format.h>

#include <iterator>

#include "base/text.h"

namespace rigc::tags {
namespace {

std::string text(const math::Vec3& v) {
  return fmt::format("[{}, {}, {}]", number_text(v.x), number_text(v.y), number_text(v.z));
}

std::string text(const math::Quat& q) {
  return fmt::format("[{}, {}, {}, {}]", number_text(q.x), number_text(q.y), number_text(q.z),
                     number_text(q.w));
}

std::string text(const Literal& literal) {
  json::Writer writer;
  write(writer, literal);
  return writer.take();
}

void dump_command(const TaggedJoint& joint, const CommandTag& command, std::string& out) {
  out += fmt::format("    {}#{}{}", command.module, command.id, command.on ? "" : " off");
  if (!command.stage.empty()) out += " stage " + command.stage;
  if (command.feature >= 0) {
    const FeatureTag& feature = joint.features[static_cast<std::size_t>(command.feature)];
    out += fmt::format(" of {}({}){}{}{}", feature.name, feature.kind,
                       feature.switch_name.empty() ? "" : ":", feature.switch_name,
                       feature.on ? "" : " off");
  }
  for (const Argument& argument : command.with)
    out += fmt::format(" {}={}", argument.name, text(argument.value));
  for (const std::string& was : command.was) out += " was " + was;
  out += "\n";
}

void dump_joint(const TaggedSkeleton& skeleton, const TaggedJoint& joint, std::string& out) {
  out += fmt::format("  {} {}", to_text(joint.key), printable(joint.name));
  if (joint.parent >= 0)
    out += " < " + printable(skeleton.joints[static_cast<std::size_t>(joint.parent)].name);
  if (!joint.ids.local.empty() || !joint.ids.label.empty())
    out += fmt::format(" is {}.{}", joint.ids.local, joint.ids.label);
  if (joint.ids.global != skeleton.global) out += " global " + joint.ids.global;
  out += fmt::format(" at {} {}", text(joint.rest.translation), text(joint.rest.rotation));
  if (joint.rest.scale != math::Vec3{1, 1, 1}) out += " scale " + text(joint.rest.scale);
  if (joint.template_parent.uid != 0) out += " under " + to_text(joint.template_parent);
  if (joint.optional) out += " optional";
  if (joint.mirror.mirrored) out += " mirrored";
  if (joint.mirror.opposite.uid != 0) out += " opposite " + to_text(joint.mirror.opposite);
  if (joint.foreign_node >= 0) out += fmt::format(" node {}", joint.foreign_node);
  if (joint.guide.between[0].uid != 0)
    out += fmt::format(" between {} {} {}", to_text(joint.guide.between[0]),
                       to_text(joint.guide.between[1]), number_text(joint.guide.share));
  if (joint.guide.toward.uid != 0)
    out += fmt::format(" toward {} up {}", to_text(joint.guide.toward), text(joint.guide.up));
  if (const auto& fitted = joint.guide.fitted)
    out += fmt::format(" fitted at {} {}", text(fitted->translation), text(fitted->rotation));
  if (joint.guide.moved) out += " moved " + text(*joint.guide.moved);
  for (const JointKey& key : joint.was) out += " was " + to_text(key);
  out += "\n";
  for (const CommandTag& command : joint.commands) dump_command(joint, command, out);
}

}  // namespace

std::string dump(const TaggedSkeleton& skeleton) {
  std::string out = fmt::format("skeleton {} global {}\n", skeleton.name, skeleton.global);
  for (const TemplateReference& reference : skeleton.templates)
    out += fmt::format("template {} {} {} {}{}\n", reference.name, reference.version,
                       reference.file, reference.digest, reference.main ? " main" : "");
  for (const auto& [module, version] : skeleton.module_pins)
    out += fmt::format("module {} {}\n", module, version);
  for (const FeatureDeclaration& feature : skeleton.features)
    out += fmt::format("feature {}({}){} switches [{}]\n", feature.name, feature.kind,
                       feature.on ? "" : " off", join(feature.switches, ", "));
  for (const NamedShape& shape : skeleton.shapes)
    out += fmt::format("shape {} {}\n", shape.name, shape.lines.size());
  for (const auto& [group, above] : skeleton.groups)
    out += fmt::format("group {} in {}\n", group, above);
  const Character& character = skeleton.character;
  out += fmt::format("character up {} left {} forward {} height {} unit {}\n", text(character.up),
                     text(character.left), text(character.forward), number_text(character.height),
                     number_text(character.unit));
  out += "joints\n";
  for (const TaggedJoint& joint : skeleton.joints) dump_joint(skeleton, joint, out);
  return out;
}

}  // namespace rigc::tags
