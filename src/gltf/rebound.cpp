// SPDX-License-Identifier: MIT
// Changes of skins as text, and undone. Test: tests/gltf/split_weights_test.cpp
#include "gltf/rebound.h"

#include <algorithm>
#include <map>

#include "gltf/rig_codes.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

using json::Value;

constexpr std::int64_t kLargestIndex = 2'000'000'000;

int index_of(const Value& value) { return static_cast<int>(value.integer().value_or(-1)); }

void write_accessors(json::Writer& writer, int before, int now) {
  writer.begin_array().value(before).value(now).end_array();
}

void read_accessors(const Value& list, JsonReader& reader, int least, int& before, int& now) {
  const auto items = list.items();
  std::int64_t first = 0, second = 0;
  if (!list.is_array() || items.size() != 2)
    return reader.fail(codes::kRigType, list, "accessors are [before, now]");
  if (!reader.whole(items[0], least, kLargestIndex, first) ||
      !reader.whole(items[1], 0, kLargestIndex, second))
    return;
  before = static_cast<int>(first);
  now = static_cast<int>(second);
}

/// The file's arrays, read once.
class Checker {
 public:
  Checker(const File& file, const Rig& rig)
      : rig_(rig),
        meshes_(file.root()["meshes"].items()),
        skins_(file.root()["skins"].items()),
        accessors_(file.root()["accessors"].items()) {}

  bool holds(const Rebound::Skin& changed) const {
    const Value skin = at(skins_, changed.skin);
    const auto joints = skin["joints"].items();
    const auto kept = static_cast<std::size_t>(changed.joints);
    if (!skin || index_of(skin["inverseBindMatrices"]) != changed.now || joints.size() <= kept ||
        !replaces(changed.before, changed.now, "MAT4"))
      return false;
    return std::all_of(joints.begin() + changed.joints, joints.end(),
                       [&](const Value& joint) { return is_ours(index_of(joint)); });
  }

  bool holds(const Rebound::Primitive& changed) const {
    const auto primitives = at(meshes_, changed.mesh)["primitives"].items();
    const Value attributes = at(primitives, changed.primitive)["attributes"];
    return attributes &&
           std::all_of(changed.attributes.begin(), changed.attributes.end(),
                       [&](const Rebound::Attribute& attribute) {
                         return index_of(attributes[attribute.name]) == attribute.now &&
                                replaces(attribute.before, attribute.now, "VEC4");
                       });
  }

 private:
  static Value at(const std::vector<Value>& list, int index) {
    return index >= 0 && index < static_cast<int>(list.size())
               ? list[static_cast<std::size_t>(index)]
               : Value();
  }

  bool is_ours(int node) const {
    return std::find(rig_.nodes.begin(), rig_.nodes.end(), node) != rig_.nodes.end();
  }

  bool replaces(int before, int now, std::string_view type) const {
    const Value was = at(accessors_, before);
    return rig_.owned.stays.accessors.contains(now) &&
           (before == -1 || was["type"].string() == type);
  }

  const Rig& rig_;
  std::vector<Value> meshes_, skins_, accessors_;
};

std::string index_text(int index) { return index < 0 ? std::string() : std::to_string(index); }

}  // namespace

void write_rebound(json::Writer& writer, const Rebound& rebound) {
  if (rebound.skins.empty()) return;
  writer.key("rebound").begin_object().key("skins").begin_array();
  for (const Rebound::Skin& skin : rebound.skins) {
    writer.begin_object().member("skin", skin.skin).member("joints", skin.joints).key("matrices");
    write_accessors(writer, skin.before, skin.now);
    writer.end_object();
  }
  writer.end_array().key("primitives").begin_array();
  for (const Rebound::Primitive& primitive : rebound.primitives) {
    writer.begin_object().member("mesh", primitive.mesh).member("primitive", primitive.primitive);
    writer.key("attributes").begin_object();
    for (const Rebound::Attribute& attribute : primitive.attributes) {
      writer.key(attribute.name);
      write_accessors(writer, attribute.before, attribute.now);
    }
    writer.end_object().end_object();
  }
  writer.end_array().end_object();
}

void read_rebound(const Value& object, JsonReader& reader, Rebound& out) {
  const Value rebound = object["rebound"];
  if (!rebound) return;
  for (const Value& item : reader.objects(rebound, "skins", kMostParts)) {
    Rebound::Skin skin;
    reader.get(item, "skin", 0, kLargestIndex, skin.skin, Need::required);
    reader.get(item, "joints", 0, kLargestIndex, skin.joints, Need::required);
    read_accessors(item["matrices"], reader, 0, skin.before, skin.now);
    out.skins.push_back(skin);
  }
  for (const Value& item : reader.objects(rebound, "primitives", kMostParts)) {
    Rebound::Primitive primitive;
    reader.get(item, "mesh", 0, kLargestIndex, primitive.mesh, Need::required);
    reader.get(item, "primitive", 0, kLargestIndex, primitive.primitive, Need::required);
    for (const auto& [name, accessors] : reader.members(item, "attributes")) {
      Rebound::Attribute& attribute = primitive.attributes.emplace_back();
      attribute.name = name;
      read_accessors(accessors, reader, -1, attribute.before, attribute.now);
    }
    out.primitives.push_back(std::move(primitive));
  }
}

bool is_rebound(const File& file, const Rig& rig) {
  const Rebound& rebound = rig.rebound;
  if (rebound.skins.empty()) return false;
  const Checker checker(file, rig);
  const auto holds = [&](const auto& changed) { return checker.holds(changed); };
  return std::all_of(rebound.skins.begin(), rebound.skins.end(), holds) &&
         std::all_of(rebound.primitives.begin(), rebound.primitives.end(), holds);
}

void unbind(Patch& patch, const Rebound& rebound, Uses& uses) {
  for (const Rebound::Skin& changed : rebound.skins) {
    const json::Document skin = parsed(patch.element("skins", changed.skin));
    Splice joints(skin.root()["joints"]);
    joints.truncate(static_cast<std::size_t>(changed.joints));
    patch.set_member("skins", changed.skin, "joints", joints.text());
    patch.set_member("skins", changed.skin, "inverseBindMatrices", index_text(changed.before));
    uses.drop_accessor(patch, changed.now, true);
  }
  std::map<int, std::vector<const Rebound::Primitive*>> by_mesh;
  for (const Rebound::Primitive& changed : rebound.primitives)
    by_mesh[changed.mesh].push_back(&changed);
  for (const auto& [mesh, list] : by_mesh) {
    const json::Document document = parsed(patch.element("meshes", mesh));
    const auto before = document.root()["primitives"].items();
    Splice primitives(document.root()["primitives"]);
    for (const Rebound::Primitive* changed : list) {
      const auto index = static_cast<std::size_t>(changed->primitive);
      Splice attributes(before[index]["attributes"]);
      for (const Rebound::Attribute& attribute : changed->attributes) {
        attributes.set(attribute.name, index_text(attribute.before));
        uses.drop_accessor(patch, attribute.now, true);
      }
      primitives.replace(
          index, with_member(std::string(before[index].text()), "attributes", attributes.text()));
    }
    patch.set_member("meshes", mesh, "primitives", primitives.text());
  }
}

}  // namespace rigc::gltf
