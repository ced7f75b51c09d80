// SPDX-License-Identifier: MIT
// A rig as the text of one entry of RIGC_rig's `rigs`, and back. Test: tests/gltf/rig_json_test.cpp
#include "gltf/rig_json.h"

#include "gltf/rebound.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json_orphans.h"
#include "gltf/rig_json_scene.h"
#include "gltf/rig_json_skeleton.h"

namespace rigc::gltf {
namespace {

constexpr std::int64_t kLargestIndex = 2'000'000'000;

void write_commands(json::Writer& writer, const Rig& rig, PlaceWriter& places) {
  writer.key("commands").begin_array();
  for (const CommandRecord& command : rig.commands) {
    json::Writer record;
    record.begin_object().member("holder", to_text(command.holder)).member("joint", command.joint);
    record.member("id", command.id).member("module", command.module);
    if (!command.ran) record.member("ran", false);
    places.write(record, command.file, command.line);
    writer.raw("\n" + record.end_object().take());
  }
  writer.end_array();
}

void read_commands(const json::Value& object, JsonReader& reader, PlaceReader& places, Rig& rig) {
  for (const json::Value& item : reader.objects(object, "commands", kMostNodes, Need::required)) {
    CommandRecord command;
    reader.get(item, "holder", command.holder, Need::required);
    reader.get(item, "joint", command.joint, Need::required);
    reader.get(item, "id", command.id, Need::required);
    reader.get(item, "module", command.module, Need::required);
    reader.get(item, "ran", command.ran);
    places.read(item, command.file, command.line);
    rig.commands.push_back(std::move(command));
  }
}

struct OwnedRow {
  const char* name;
  Slots Owned::Part::*slots;
};
constexpr OwnedRow kOwnedRows[] = {
    {"nodes", &Owned::Part::nodes},         {"meshes", &Owned::Part::meshes},
    {"materials", &Owned::Part::materials}, {"skins", &Owned::Part::skins},
    {"accessors", &Owned::Part::accessors}, {"bufferViews", &Owned::Part::buffer_views}};

void write_owned(json::Writer& writer, const Owned& owned) {
  writer.key("owned").begin_object();
  for (const bool stays : {true, false}) {
    const Owned::Part& part = stays ? owned.stays : owned.goes;
    writer.key(stays ? "stays" : "goes").begin_object();
    for (const OwnedRow& row : kOwnedRows) {
      if ((part.*row.slots).empty()) continue;
      writer.key(row.name).begin_array();
      for (const Range& run : (part.*row.slots).runs) writer.value(run.first).value(run.count);
      writer.end_array();
    }
    writer.end_object();
  }
  writer.end_object();
}

void read_slots(const json::Value& list, JsonReader& reader, Slots& out) {
  const auto numbers = list.items();
  if (!list.is_array() || numbers.size() % 2 != 0)
    return reader.fail(codes::kRigType, list, "runs are [first, count, ...]");
  for (std::size_t i = 0; i < numbers.size(); i += 2) {
    std::int64_t first = 0, count = 0;
    if (reader.whole(numbers[i], 0, kLargestIndex, first) &&
        reader.whole(numbers[i + 1], 0, kLargestIndex - first, count))
      out.runs.push_back({static_cast<int>(first), static_cast<int>(count)});
  }
}

void read_owned(const json::Value& object, JsonReader& reader, Owned& out) {
  const json::Value owned = object["owned"];
  if (!owned.is_object()) return reader.fail(codes::kRigType, object, "\"owned\" is missing");
  for (const bool stays : {true, false}) {
    for (const OwnedRow& row : kOwnedRows) {
      const json::Value list = owned[stays ? "stays" : "goes"][row.name];
      if (list) read_slots(list, reader, (stays ? out.stays : out.goes).*row.slots);
    }
  }
}

}  // namespace

std::string to_json(const Rig& rig, const Sources& sources) {
  PlaceWriter places(sources, reference_names(rig.skeleton.templates));
  json::Writer writer;
  writer.begin_object().member("id", rig.id);
  write_skeleton(writer, rig.skeleton, places);
  write_settings(writer, rig.settings);
  if (rig.ancestor >= 0) writer.member("ancestor", rig.ancestor);
  write_versions(writer.key("modules"), rig.modules);
  write_commands(writer, rig, places);
  write_scene(writer, rig, places);
  writer.key("files").begin_array();
  for (const std::string& file : places.files()) writer.value(file);
  writer.end_array();
  write_orphans(writer, rig);
  write_owned(writer, rig.owned);
  write_rebound(writer, rig.rebound);
  return writer.end_object().take();
}

std::optional<Rig> from_json(const json::Value& object, const std::string& file,
                             Diagnostics& diagnostics, Origins origins, std::size_t* room) {
  JsonReader reader(file, diagnostics, room ? *room : kMostParts);
  Rig rig;
  reader.get(object, "id", 0, UINT32_MAX, rig.id, Need::required);
  PlaceReader places(object, reader, origins == Origins::file ? file : "");
  read_skeleton(object, reader, places, rig.skeleton);
  read_settings(object, reader, rig.settings);
  reader.get(object, "ancestor", 0, kLargestIndex, rig.ancestor);
  rig.modules = read_versions(object, "modules", reader);
  read_commands(object, reader, places, rig);
  read_owned(object, reader, rig.owned);
  read_rebound(object, reader, rig.rebound);
  if (reader.ok()) read_scene(object, reader, places, rig);
  if (reader.ok()) read_orphans(object, reader, rig);
  if (room) *room = reader.room();
  if (!reader.ok()) return std::nullopt;
  return rig;
}

}  // namespace rigc::gltf
