// SPDX-License-Identifier: MIT
// Joints and their tags in RIGC_rig. Test: tests/gltf/rig_json_test.cpp
#include "gltf/rig_json_joints.h"

#include <fmt/format.h>

#include <set>

#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"

namespace rigc::gltf {
namespace {

constexpr std::size_t kMostTags = 65536;
constexpr std::int64_t kLargestIndex = 2'000'000'000;

void write_keys(json::Writer& writer, const std::vector<JointKey>& keys) {
  writer.begin_array();
  for (const JointKey& key : keys) writer.value(to_text(key));
  writer.end_array();
}

void write_feature_tags(json::Writer& writer, const tags::TaggedJoint& joint, PlaceWriter& places) {
  if (joint.features.empty()) return;
  writer.key("features").begin_array();
  for (const tags::FeatureTag& feature : joint.features) {
    writer.begin_object();
    if (!feature.name.empty()) writer.member("name", feature.name);
    if (!feature.kind.empty()) writer.member("kind", feature.kind);
    if (!feature.switch_name.empty()) writer.member("switch", feature.switch_name);
    if (!feature.on) writer.member("on", false);
    places.write(writer, feature.span);
    writer.end_object();
  }
  writer.end_array();
}

void write_command_tags(json::Writer& writer, const tags::TaggedJoint& joint, PlaceWriter& places) {
  if (joint.commands.empty()) return;
  writer.key("commands").begin_array();
  for (const tags::CommandTag& command : joint.commands) {
    writer.begin_object().member("module", command.module).member("id", command.id);
    if (!command.comment.empty()) writer.member("comment", command.comment);
    if (!command.stage.empty()) writer.member("stage", command.stage);
    if (!command.on) writer.member("on", false);
    if (command.feature >= 0) writer.member("feature", command.feature);
    if (!command.with.empty()) {
      writer.key("with").begin_object();
      for (const tags::Argument& argument : command.with)
        rigc::write(writer.key(argument.name), argument.value);
      writer.end_object();
    }
    if (!command.was.empty()) {
      writer.key("was").begin_array();
      for (const std::string& was : command.was) writer.value(was);
      writer.end_array();
    }
    places.write(writer, command.span);
    writer.end_object();
  }
  writer.end_array();
}

void write_guide(json::Writer& writer, const tags::Guiding& guide) {
  if (guide.fitted) {
    write_rest(writer.key("fitted").begin_object(), *guide.fitted);
    writer.end_object();
  }
  if (guide.moved) writer.key("moved").numbers(&guide.moved->x, 3);
  if (guide.toward != JointKey{}) {
    writer.member("toward", to_text(guide.toward));
    writer.key("up").numbers(&guide.up.x, 3);
  }
  if (guide.between[0] == JointKey{}) return;
  write_keys(writer.key("between"), {guide.between.begin(), guide.between.end()});
  writer.member("share", guide.share);
}

std::string joint_text(const tags::TaggedJoint& joint, const std::string& global,
                       PlaceWriter& places) {
  json::Writer writer;
  writer.begin_object().member("name", joint.name).member("key", to_text(joint.key));
  if (!joint.was.empty()) write_keys(writer.key("was"), joint.was);
  if (joint.parent >= 0) writer.member("parent", joint.parent);
  if (joint.template_parent != JointKey{})
    writer.member("template_parent", to_text(joint.template_parent));
  write_identifiers(writer, joint.ids, global);
  write_rest(writer, joint.rest);
  if (joint.optional) writer.member("optional", true);
  if (joint.mirror.mirrored) writer.member("mirrored", true);
  if (joint.mirror.opposite != JointKey{})
    writer.member("opposite", to_text(joint.mirror.opposite));
  if (joint.template_index != 0) writer.member("template", joint.template_index);
  if (joint.foreign_node >= 0) writer.member("foreign_node", joint.foreign_node);
  write_guide(writer, joint.guide);
  write_feature_tags(writer, joint, places);
  write_command_tags(writer, joint, places);
  places.write(writer, joint.span);
  return writer.end_object().take();
}

/// An argument is found where its command is: columns of arguments are not kept.
void read_arguments(const json::Value& item, JsonReader& reader, tags::CommandTag& command) {
  for (const auto& [name, value] : reader.members(item, "with")) {
    // A value has two bytes at least: itself and what divides it from the next.
    if (!reader.spend(value, value.text().size() / 2)) return;
    auto literal = literal_from(value);
    if (!literal) {
      reader.fail(codes::kRigType, value, "an argument is a plain value");
      continue;
    }
    literal->span = command.span;
    command.with.push_back({name, command.span, std::move(*literal)});
  }
}

void read_tags(const json::Value& item, JsonReader& reader, PlaceReader& places,
               tags::TaggedJoint& joint) {
  for (const json::Value& tag : reader.objects(item, "features", kMostTags)) {
    tags::FeatureTag feature;
    reader.get(tag, "name", feature.name);
    reader.get(tag, "kind", feature.kind);
    reader.get(tag, "switch", feature.switch_name);
    reader.get(tag, "on", feature.on);
    feature.span = places.read(tag);
    joint.features.push_back(std::move(feature));
  }
  const auto features = static_cast<std::int64_t>(joint.features.size());
  std::set<std::string> ids;
  for (const json::Value& tag : reader.objects(item, "commands", kMostTags)) {
    tags::CommandTag command;
    reader.get(tag, "module", command.module, Need::required);
    reader.get(tag, "id", command.id, Need::required);
    reader.get(tag, "comment", command.comment);
    reader.get(tag, "stage", command.stage);
    reader.get(tag, "on", command.on);
    reader.get(tag, "feature", 0, features - 1, command.feature);
    reader.get(tag, "was", command.was);
    command.span = places.read(tag);
    read_arguments(tag, reader, command);
    if (!ids.insert(command.id).second)
      reader.fail(codes::kRigDuplicate, tag, "another command of this joint has the same id");
    joint.commands.push_back(std::move(command));
  }
}

void read_rest(const json::Value& item, JsonReader& reader, math::Trs& rest) {
  reader.get(item, "translation", rest.translation);
  reader.get(item, "rotation", rest.rotation);
  reader.get(item, "scale", rest.scale);
}

void read_guide(const json::Value& item, JsonReader& reader, tags::Guiding& guide) {
  if (const json::Value fitted = item["fitted"]) read_rest(fitted, reader, guide.fitted.emplace());
  if (item["moved"]) reader.get(item, "moved", guide.moved.emplace());
  reader.get(item, "toward", guide.toward);
  reader.get(item, "up", guide.up);
  const auto between = reader.items(item, "between");
  if (between.size() == 2)
    for (std::size_t i = 0; i < 2; ++i) reader.read(between[i], guide.between[i]);
  else if (!between.empty())
    reader.fail(codes::kRigValue, item["between"], "a joint lies between two others");
  reader.get(item, "share", guide.share);
}

tags::TaggedJoint read_joint(const json::Value& item, JsonReader& reader, PlaceReader& places,
                             const tags::TaggedSkeleton& skeleton) {
  tags::TaggedJoint joint;
  reader.get(item, "name", joint.name, Need::required);
  reader.get(item, "key", joint.key, Need::required);
  for (const json::Value& was : reader.items(item, "was")) {
    JointKey key;
    if (reader.read(was, key)) joint.was.push_back(key);
  }
  reader.get(item, "parent", 0, static_cast<std::int64_t>(skeleton.joints.size()) - 1,
             joint.parent);
  reader.get(item, "template_parent", joint.template_parent);
  read_identifiers(item, reader, skeleton.global, joint.ids);
  read_rest(item, reader, joint.rest);
  reader.get(item, "optional", joint.optional);
  reader.get(item, "mirrored", joint.mirror.mirrored);
  reader.get(item, "opposite", joint.mirror.opposite);
  const auto templates = static_cast<std::int64_t>(skeleton.templates.size());
  reader.get(item, "template", 0, templates - 1, joint.template_index);
  reader.get(item, "foreign_node", 0, kLargestIndex, joint.foreign_node);
  read_guide(item, reader, joint.guide);
  joint.span = places.read(item);
  read_tags(item, reader, places, joint);
  return joint;
}

}  // namespace

void write_rest(json::Writer& writer, const math::Trs& rest) {
  if (rest.translation != math::Vec3{}) writer.key("translation").numbers(&rest.translation.x, 3);
  if (rest.rotation != math::Quat{}) writer.key("rotation").numbers(&rest.rotation.x, 4);
  if (rest.scale != math::Vec3{1, 1, 1}) writer.key("scale").numbers(&rest.scale.x, 3);
}

void write_identifiers(json::Writer& writer, const Identifiers& ids, const std::string& global) {
  if (ids.global != global) writer.member("global", ids.global);
  if (!ids.local.empty()) writer.member("local", ids.local);
  if (!ids.label.empty()) writer.member("label", ids.label);
}

void read_identifiers(const json::Value& object, JsonReader& reader, const std::string& global,
                      Identifiers& out) {
  out.global = global;
  reader.get(object, "global", out.global);
  reader.get(object, "local", out.local);
  reader.get(object, "label", out.label);
}

void write_joints(json::Writer& writer, const tags::TaggedSkeleton& skeleton, PlaceWriter& places) {
  writer.key("joints").begin_array();
  for (const tags::TaggedJoint& joint : skeleton.joints)
    writer.raw("\n" + joint_text(joint, skeleton.global, places));
  writer.end_array();
}

void read_joints(const json::Value& rig, JsonReader& reader, PlaceReader& places,
                 tags::TaggedSkeleton& out) {
  std::set<JointKey> keys;
  for (const json::Value& item : reader.objects(rig, "joints", kMostJoints, Need::required)) {
    tags::TaggedJoint joint = read_joint(item, reader, places, out);
    if (!keys.insert(joint.key).second)
      reader.fail(codes::kRigDuplicate, item["key"],
                  fmt::format("another joint has the key {} too", to_text(joint.key)));
    out.joints.push_back(std::move(joint));
  }
}

}  // namespace rigc::gltf
