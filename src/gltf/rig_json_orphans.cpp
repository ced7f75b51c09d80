// SPDX-License-Identifier: MIT
// Orphans in RIGC_rig and on their nodes. Test: tests/gltf/rig_orphans_test.cpp
#include "gltf/rig_json_orphans.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "gltf/float_text.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_joints.h"
#include "gltf/rig_json_values.h"
#include "gltf/rig_nodes.h"

namespace rigc::gltf {
namespace {

constexpr std::int64_t kLargestNode = 2'000'000'000;
constexpr std::size_t kMostAttributes = 900;

void write_space(json::Writer& writer, const math::Mat3& space) {
  if (space == math::Mat3{}) return;
  const double numbers[] = {space.x.x, space.x.y, space.x.z, space.y.x, space.y.y,
                            space.y.z, space.z.x, space.z.y, space.z.z};
  writer.key("space").numbers(numbers, 9);
}

void read_space(const json::Value& item, JsonReader& reader, math::Mat3& out) {
  std::vector<double> n;
  if (!reader.get(item, "space", n)) return;
  if (n.size() != 9) return reader.fail(codes::kRigType, item["space"], "axes are nine numbers");
  out = {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
}

void read_attributes(const json::Value& item, JsonReader& reader, Orphan& orphan) {
  for (const json::Value& entry : reader.objects(item, "attributes", kMostAttributes)) {
    scene::UserAttribute attribute;
    std::string flavour;
    reader.get(entry, "name", attribute.name, Need::required);
    reader.get(entry, "flavour", flavour, Need::required);
    const auto known = parse_flavour(flavour);
    if (!known || !is_name(attribute.name) || attribute.name == "rigc")
      return reader.fail(codes::kRigText, entry,
                         fmt::format("\"{}\" is no attribute", printable(attribute.name)));
    const auto& known_ones = orphan.attributes;
    if (std::any_of(known_ones.begin(), known_ones.end(),
                    [&](const auto& one) { return one.name == attribute.name; }))
      return reader.fail(codes::kRigDuplicate, entry,
                         fmt::format("the orphan has two attributes \"{}\"", attribute.name));
    attribute.flavour = *known;
    reader.get(entry, "initial", attribute.initial);
    orphan.attributes.push_back(std::move(attribute));
  }
}

}  // namespace

std::string orphan_mark(const Identity& identity) { return "orphan:" + to_text(identity); }

void write_orphans(json::Writer& writer, const Rig& rig) {
  if (rig.orphans.empty()) return;
  writer.key("orphans").begin_array();
  for (const Orphan& orphan : rig.orphans) {
    json::Writer item;
    Identity identity = orphan.identity;
    identity.rig = rig.id;
    item.begin_object().member("node", orphan.node).member("identity", to_text(identity));
    item.member("name", orphan.name);
    write_identifiers(item, orphan.ids, rig.skeleton.global);
    item.member("kind", scene::spec(orphan.kind).name);
    if (!orphan.module.empty()) item.member("module", orphan.module);
    write_space(item, orphan.space);
    write_rest(item, orphan.rest);
    if (!orphan.attributes.empty()) item.key("attributes").begin_array();
    for (const scene::UserAttribute& attribute : orphan.attributes)
      item.begin_object()
          .member("name", attribute.name)
          .member("flavour", name_of(attribute.flavour))
          .member("initial", attribute.initial)
          .end_object();
    if (!orphan.attributes.empty()) item.end_array();
    writer.raw("\n" + item.end_object().take());
  }
  writer.end_array();
}

void read_orphans(const json::Value& object, JsonReader& reader, Rig& rig) {
  for (const json::Value& item : reader.objects(object, "orphans", kMostNodes)) {
    Orphan orphan;
    std::string kind;
    reader.get(item, "node", 0, kLargestNode, orphan.node, Need::required);
    reader.get(item, "identity", orphan.identity, Need::required);
    reader.get(item, "name", orphan.name);
    read_identifiers(item, reader, rig.skeleton.global, orphan.ids);
    reader.get(item, "kind", kind, Need::required);
    reader.get(item, "module", orphan.module);
    read_space(item, reader, orphan.space);
    reader.get(item, "translation", orphan.rest.translation);
    reader.get(item, "rotation", orphan.rest.rotation);
    reader.get(item, "scale", orphan.rest.scale);
    read_attributes(item, reader, orphan);
    if (!reader.ok()) return;
    const auto known = scene::parse_kind(kind);
    if (!known || !scene::spec(*known).is_transform)
      return reader.fail(codes::kRigWord, item["kind"], "an orphan is a transform");
    if (orphan.identity.rig != rig.id)
      return reader.fail(codes::kRigText, item["identity"], "the orphan is of another rig");
    orphan.kind = *known;
    rig.orphans.push_back(std::move(orphan));
  }
}

void find_orphans(const File& file, const Slim& slim, const std::vector<json::Value>& nodes,
                  Rig& rig, std::set<int>& taken, Diagnostics& diagnostics) {
  if (rig.orphans.empty()) return;
  std::multimap<std::string, int> marked;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto mark = nodes[i]["extras"]["rigc"].string();
    if (mark && starts_with(*mark, "orphan:")) marked.emplace(*mark, static_cast<int>(i));
  }
  std::vector<Orphan> found;
  for (Orphan& orphan : rig.orphans) {
    const auto [first, last] = marked.equal_range(orphan_mark(orphan.identity));
    auto at =
        std::find_if(first, last, [&](const auto& entry) { return entry.second == orphan.node; });
    if (at == last) at = first;
    if (at == last || !taken.insert(at->second).second) {
      diagnostics.report(codes::kNodeLost, Place(file.path, fmt::format("/nodes/{}", orphan.node)),
                         fmt::format("no node holds what was on \"{}\" of rig {}",
                                     printable(orphan.name), rig.id));
      continue;
    }
    orphan.node = at->second;
    marked.erase(at);
    orphan.local = slim.node(orphan.node).local;
    const json::Value extras = nodes[static_cast<std::size_t>(orphan.node)]["extras"];
    for (scene::UserAttribute& attribute : orphan.attributes)
      attribute.value = extras[attribute.name].number().value_or(0);
    found.push_back(std::move(orphan));
  }
  rig.orphans = std::move(found);
}

std::string orphan_text(const Rig& rig, const Orphan& orphan) {
  Identity identity = orphan.identity;
  identity.rig = rig.id;
  std::string text = "{";
  const auto add = [&](std::string_view name, const std::string& value) {
    if (text.size() > 1) text += ',';
    text += json::quote(name) + ':' + value;
  };
  if (!orphan.name.empty()) add("name", json::quote(orphan.name));
  write_local(orphan.local, true, add);
  add("extras", extras_text(orphan_mark(identity), orphan.attributes));
  return text + '}';
}

}  // namespace rigc::gltf
