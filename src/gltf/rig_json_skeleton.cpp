// SPDX-License-Identifier: MIT
// Declarations, shapes and settings of a rig in RIGC_rig; rig_json_joints.cpp has the joints.
// Test: tests/gltf/rig_json_test.cpp
#include "gltf/rig_json_skeleton.h"

#include <fmt/format.h>

#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_joints.h"

namespace rigc::gltf {
namespace {

constexpr std::size_t kMostDeclared = 65536;
constexpr int kLargestVersion = 1'000'000'000;

void write_strings(json::Writer& writer, const std::vector<std::string>& texts) {
  writer.begin_array();
  for (const std::string& text : texts) writer.value(text);
  writer.end_array();
}

void write_templates(json::Writer& writer, const std::vector<tags::TemplateReference>& templates) {
  const std::vector<std::string> files = reference_names(templates);
  writer.key("templates").begin_array();
  for (std::size_t i = 0; i < templates.size(); ++i) {
    writer.begin_object().member("name", templates[i].name);
    writer.member("version", templates[i].version);
    if (!templates[i].digest.empty()) writer.member("digest", templates[i].digest);
    if (!files[i].empty()) writer.member("file", files[i]);
    if (templates[i].main) writer.member("main", true);
    writer.end_object();
  }
  writer.end_array();
}

void read_templates(const json::Value& rig, JsonReader& reader, tags::TaggedSkeleton& out) {
  for (const json::Value& item : reader.objects(rig, "templates", kMostDeclared)) {
    tags::TemplateReference reference;
    reader.get(item, "name", reference.name, Need::required);
    reader.get(item, "version", 0, kLargestVersion, reference.version, Need::required);
    if (reader.get(item, "digest", reference.digest) && !parse_hex16(reference.digest))
      reader.fail(codes::kRigText, item["digest"], "a digest has 16 hex digits");
    reader.get(item, "file", reference.file);
    reader.get(item, "main", reference.main);
    out.templates.push_back(std::move(reference));
  }
}

void write_features(json::Writer& writer, const std::vector<tags::FeatureDeclaration>& features) {
  if (features.empty()) return;
  writer.key("features").begin_array();
  for (const tags::FeatureDeclaration& feature : features) {
    writer.begin_object().member("name", feature.name);
    if (!feature.kind.empty()) writer.member("kind", feature.kind);
    if (!feature.title.empty()) writer.member("title", feature.title);
    if (!feature.help.empty()) writer.member("help", feature.help);
    if (!feature.on) writer.member("on", false);
    if (!feature.switches.empty()) write_strings(writer.key("switches"), feature.switches);
    writer.end_object();
  }
  writer.end_array();
}

void read_features(const json::Value& rig, JsonReader& reader, tags::TaggedSkeleton& out) {
  for (const json::Value& item : reader.objects(rig, "features", kMostDeclared)) {
    tags::FeatureDeclaration feature;
    reader.get(item, "name", feature.name, Need::required);
    reader.get(item, "kind", feature.kind);
    reader.get(item, "title", feature.title);
    reader.get(item, "help", feature.help);
    reader.get(item, "on", feature.on);
    reader.get(item, "switches", feature.switches);
    out.features.push_back(std::move(feature));
  }
}

void write_groups(json::Writer& writer,
                  const std::vector<std::pair<std::string, std::string>>& groups) {
  if (groups.empty()) return;
  writer.key("groups").begin_array();
  for (const auto& [name, above] : groups)
    writer.begin_object().member("name", name).member("in", above).end_object();
  writer.end_array();
}

void read_groups(const json::Value& rig, JsonReader& reader, tags::TaggedSkeleton& out) {
  for (const json::Value& item : reader.objects(rig, "groups", kMostDeclared)) {
    auto& [name, above] = out.groups.emplace_back();
    reader.get(item, "name", name, Need::required);
    reader.get(item, "in", above, Need::required);
  }
}

/// Each polyline is a flat list of coordinates.
void write_shapes(json::Writer& writer, const std::vector<tags::NamedShape>& shapes) {
  if (shapes.empty()) return;
  writer.key("shapes").begin_array();
  for (const tags::NamedShape& shape : shapes) {
    writer.begin_object().member("name", shape.name).key("lines").begin_array();
    for (const auto& line : shape.lines) {
      std::vector<double> flat;
      for (const math::Vec3& point : line) flat.insert(flat.end(), {point.x, point.y, point.z});
      writer.numbers(flat.data(), flat.size());
    }
    writer.end_array().end_object();
  }
  writer.end_array();
}

void read_shapes(const json::Value& rig, JsonReader& reader, tags::TaggedSkeleton& out) {
  for (const json::Value& item : reader.objects(rig, "shapes", kMostDeclared)) {
    tags::NamedShape shape;
    reader.get(item, "name", shape.name, Need::required);
    for (const json::Value& line : reader.items(item, "lines")) {
      std::vector<double> flat;
      if (!reader.read(line, flat)) continue;
      if (flat.size() % 3 != 0)
        reader.fail(codes::kRigValue, line, "points have three coordinates");
      std::vector<math::Vec3>& points = shape.lines.emplace_back();
      for (std::size_t i = 0; i + 2 < flat.size(); i += 3)
        points.push_back({flat[i], flat[i + 1], flat[i + 2]});
    }
    out.shapes.push_back(std::move(shape));
  }
}

void write_character(json::Writer& writer, const tags::Character& character) {
  writer.key("character").begin_object();
  writer.key("up").numbers(&character.up.x, 3);
  writer.key("left").numbers(&character.left.x, 3);
  writer.key("forward").numbers(&character.forward.x, 3);
  writer.member("height", character.height).member("unit", character.unit).end_object();
}

void read_character(const json::Value& rig, JsonReader& reader, tags::Character& out) {
  const json::Value character = rig["character"];
  if (!character.is_object()) return reader.fail(codes::kRigType, rig, "\"character\" is missing");
  reader.get(character, "up", out.up, Need::required);
  reader.get(character, "left", out.left, Need::required);
  reader.get(character, "forward", out.forward, Need::required);
  reader.get(character, "height", out.height, Need::required);
  reader.get(character, "unit", out.unit, Need::required);
  if (out.unit <= 0 || out.height < 0)
    reader.fail(codes::kRigValue, character, "height and unit of a character are not negative");
}

}  // namespace

void write_versions(json::Writer& writer, const std::vector<std::pair<std::string, int>>& modules) {
  writer.begin_array();
  for (const auto& [name, version] : modules)
    writer.begin_object().member("name", name).member("version", version).end_object();
  writer.end_array();
}

std::vector<std::pair<std::string, int>> read_versions(const json::Value& object,
                                                       std::string_view key, JsonReader& reader) {
  std::vector<std::pair<std::string, int>> out;
  for (const json::Value& item : reader.objects(object, key, kMostDeclared)) {
    auto& [name, version] = out.emplace_back();
    reader.get(item, "name", name, Need::required);
    reader.get(item, "version", 0, kLargestVersion, version, Need::required);
  }
  return out;
}

void write_settings(json::Writer& writer, const tags::Settings& settings) {
  writer.key("settings").begin_object().member("rest", settings.rest);
  if (!settings.features.empty()) {
    writer.key("features").begin_array();
    for (const auto& feature : settings.features) {
      writer.begin_object().member("name", feature.name);
      if (!feature.group.empty()) writer.member("group", feature.group);
      if (!feature.switch_name.empty()) writer.member("switch", feature.switch_name);
      writer.member("on", feature.on).end_object();
    }
    writer.end_array();
  }
  if (!settings.groups.empty()) {
    writer.key("groups").begin_array();
    for (const auto& [name, on] : settings.groups)
      writer.begin_object().member("name", name).member("on", on).end_object();
    writer.end_array();
  }
  if (settings.split_weights) writer.member("split_weights", true);
  writer.end_object();
}

void read_settings(const json::Value& rig, JsonReader& reader, tags::Settings& out) {
  const json::Value settings = rig["settings"];
  if (!settings.is_object()) return reader.fail(codes::kRigType, rig, "\"settings\" is missing");
  reader.get(settings, "rest", out.rest);
  reader.get(settings, "split_weights", out.split_weights);
  for (const json::Value& item : reader.objects(settings, "features", kMostDeclared)) {
    tags::Settings::Feature feature;
    reader.get(item, "name", feature.name, Need::required);
    reader.get(item, "group", feature.group);
    reader.get(item, "switch", feature.switch_name);
    reader.get(item, "on", feature.on, Need::required);
    out.features.push_back(std::move(feature));
  }
  for (const json::Value& item : reader.objects(settings, "groups", kMostDeclared)) {
    auto& [name, on] = out.groups.emplace_back();
    reader.get(item, "name", name, Need::required);
    reader.get(item, "on", on, Need::required);
  }
}

void write_skeleton(json::Writer& writer, const tags::TaggedSkeleton& skeleton,
                    PlaceWriter& places) {
  writer.member("name", skeleton.name).member("global", skeleton.global);
  write_templates(writer, skeleton.templates);
  if (!skeleton.module_pins.empty())
    write_versions(writer.key("module_pins"), skeleton.module_pins);
  write_features(writer, skeleton.features);
  write_shapes(writer, skeleton.shapes);
  write_groups(writer, skeleton.groups);
  write_character(writer, skeleton.character);
  if (skeleton.aims) writer.member("aims", true);
  write_joints(writer, skeleton, places);
}

void read_skeleton(const json::Value& rig, JsonReader& reader, PlaceReader& places,
                   tags::TaggedSkeleton& out) {
  reader.get(rig, "name", out.name, Need::required);
  reader.get(rig, "global", out.global, Need::required);
  read_templates(rig, reader, out);
  out.module_pins = read_versions(rig, "module_pins", reader);
  read_features(rig, reader, out);
  read_shapes(rig, reader, out);
  read_groups(rig, reader, out);
  read_character(rig, reader, out.character);
  reader.get(rig, "aims", out.aims);
  read_joints(rig, reader, places, out);
}

std::vector<tags::TemplateReference> read_template_references(const json::Value& rig,
                                                              JsonReader& reader) {
  tags::TaggedSkeleton skeleton;
  read_templates(rig, reader, skeleton);
  return std::move(skeleton.templates);
}

}  // namespace rigc::gltf
