// SPDX-License-Identifier: MIT
// Two rigs' texts as one: what counts by order counts on behind the first rig's. Test:
// tests/pipeline/merge_into_test.cpp
#include <algorithm>

#include "gltf/merge_edits.h"
#include "gltf/merge_into_parts.h"
#include "gltf/merge_places.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

using json::Value;

std::string numbers(const double* first, std::size_t count) {
  json::Writer writer;
  return writer.numbers(first, count).take();
}

/// The three members of a placement, under the names that joints or values have.
std::vector<std::pair<const char*, std::string>> placement(const math::Trs& trs, bool of_joint) {
  return {{of_joint ? "translation" : "translate", numbers(&trs.translation.x, 3)},
          {"rotation", numbers(&trs.rotation.x, 4)},
          {"scale", numbers(&trs.scale.x, 3)}};
}

/// How many there were before the rig that joins.
struct Counts {
  std::int64_t joints, nodes, commands, files, templates;
};

/// Edits the text of the rig that joins.
class FromText {
 public:
  FromText(const Joining& joining, const Moved& moved, const Counts& counts)
      : joining_(joining), moved_(moved), counts_(counts) {
    places_.rigs[joining.from.rig.id] = joining.into.rig.id;
  }

  void run() {
    const Value item = joining_.from.item;
    const auto joints = item["joints"].items();
    for (std::size_t i = 0; i < joints.size(); ++i) edit_joint(joints[i], static_cast<int>(i));
    for (const Value& command : item["commands"].items()) shift_file(command);
    const auto nodes = item["nodes"].items();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      edit_node(nodes[i], scene::NodeId{static_cast<std::uint32_t>(i)});
    for (const Value& orphan : item["orphans"].items()) edit_orphan(orphan);
    const auto templates = item["templates"].items();
    if (!templates.empty() && !templates[0]["main"]) edits.insert(templates[0], "main", "true");
    edits.sort();
  }

  Edits edits;

 private:
  void edit_joint(const Value& joint, int index) {
    shift(joint["parent"], counts_.joints);
    if (joint["template"])
      shift(joint["template"], counts_.templates);
    else
      edits.insert(joint, "template", std::to_string(counts_.templates));
    shift_file(joint);
    for (const char* tags : {"features", "commands"})
      for (const Value& tag : joint[tags].items()) shift_file(tag);
    turn(joint["moved"]);
    turn(joint["up"]);
    const auto moved = moved_.joints.find(index);
    if (moved == moved_.joints.end()) return;
    edits.insert(joint, "parent", std::to_string(joining_.roots.at(index)));
    for (const auto& [name, text] : placement(moved->second, true)) set(joint, name, text);
    const tags::TaggedJoint& own =
        joining_.from.rig.skeleton.joints[static_cast<std::size_t>(index)];
    if (!own.guide.fitted) return;
    const math::Affine fitted = math::compose(moved->second) * inverse(math::compose(own.rest)) *
                                math::compose(*own.guide.fitted);
    json::Writer writer;
    writer.begin_object();
    for (const auto& [name, text] : placement(math::decompose(fitted), true))
      writer.key(name).raw(text);
    edits.replace(joint["fitted"], writer.end_object().take());
  }

  void edit_node(const Value& node, scene::NodeId id) {
    renumber(node["identity"]);
    renumber(node["values"]["opposite"]);
    shift(node["command"], counts_.commands);
    shift(node["parent"], counts_.nodes);
    for (const Value& child : node["children"].items()) shift(child, counts_.nodes);
    for (const Value& input : node["inputs"].items()) {
      const auto parts = input.items();
      if (parts.size() == 3) shift(parts[1], counts_.nodes);
    }
    shift_file(node);
    const auto moved = moved_.nodes.find(id);
    if (moved == moved_.nodes.end()) return;
    const auto& joint =
        joining_.into.rig.skeleton.joints[static_cast<std::size_t>(moved->second.first)];
    const scene::NodeId above = joint_node(joining_.into.rig, joint.key);
    edits.insert(node, "parent", std::to_string(above.index));
    place(node, moved->second.second);
  }

  /// What it holds is seen from axes of the rig's space.
  void edit_orphan(const Value& orphan) {
    renumber(orphan["identity"]);
    const auto items = orphan["space"].items();
    double n[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (std::size_t i = 0; i < 9 && items.size() == 9; ++i) n[i] = items[i].number().value_or(0);
    const math::Mat3 axes{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
    const math::Mat3 now = joining_.space.linear * axes;
    if (now == axes) return;
    const double out[] = {now.x.x, now.x.y, now.x.z, now.y.x, now.y.y,
                          now.y.z, now.z.x, now.z.y, now.z.z};
    set(orphan, "space", numbers(out, 9));
  }

  /// A vector in the rig's space.
  void turn(const Value& value) {
    const auto items = value.items();
    if (items.size() != 3) return;
    const math::Vec3 was{items[0].number().value_or(0), items[1].number().value_or(0),
                         items[2].number().value_or(0)};
    const math::Vec3 now = joining_.space.linear * was;
    edits.replace(value, numbers(&now.x, 3));
  }

  void place(const Value& node, const math::Trs& trs) {
    const Value values = node["values"];
    if (values.size() != 0) {
      for (const auto& [name, text] : placement(trs, false)) set(values, name, text);
      return;
    }
    json::Writer writer;
    writer.begin_object();
    for (const auto& [name, text] : placement(trs, false)) writer.key(name).raw(text);
    const std::string text = writer.end_object().take();
    if (values)
      edits.replace(values, text);
    else
      edits.insert(node, "values", text);
  }

  void set(const Value& object, const char* name, const std::string& text) {
    if (object[name])
      edits.replace(object[name], text);
    else
      edits.insert(object, name, text);
  }

  void shift(const Value& value, std::int64_t by) {
    if (const auto number = value.integer()) edits.replace(value, std::to_string(*number + by));
  }

  void shift_file(const Value& object) {
    const auto at = object["at"].items();
    if (!at.empty()) shift(at[0], counts_.files);
  }

  void renumber(const Value& value) {
    const auto text = value.string();
    const auto now = text ? renumbered(*text, places_) : std::nullopt;
    if (now) edits.replace(value, json::quote(*now));
  }

  const Joining& joining_;
  const Moved& moved_;
  const Counts& counts_;
  Places places_;
};

/// Items of both lists, each on a line of its own where `lines`.
std::string both_lists(const Value& a, const Value& b, const Edits& edits, bool lines) {
  std::string out = "[";
  const auto add = [&](const std::string& text) {
    if (out.size() > 1) out += ',';
    out += (lines ? "\n" : "") + text;
  };
  for (const Value& item : a.items()) add(std::string(item.text()));
  for (const Value& item : b.items()) add(edits.text(item));
  return out + "]";
}

/// Items of the second list that have a name that the first has not, behind those of the first.
std::string united(const Value& a, const Value& b) {
  std::string out = "[";
  std::set<std::string> names;
  for (const Value& list : {a, b})
    for (const Value& item : list.items())
      if (names.insert(item["name"].string().value_or("")).second)
        out += (out.size() > 1 ? "," : "") + std::string(item.text());
  return out + "]";
}

std::set<std::string> local_groups(const Rig& rig) {
  std::set<std::string> out;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints)
    if (!joint.ids.local.empty()) out.insert(joint.ids.local);
  return out;
}

bool has_feature(const Rig& rig, const std::string& name) {
  for (const tags::TaggedJoint& joint : rig.skeleton.joints)
    for (const tags::FeatureTag& feature : joint.features)
      if (feature.name == name) return true;
  return false;
}

/// A rig's settings of features. What holds for the whole rig is said of each of its groups where
/// the other rig has the feature too.
void add_features(const Rig& rig, const Rig& other, json::Writer& writer) {
  const auto add = [&](const tags::Settings::Feature& feature, const std::string& group) {
    writer.begin_object().member("name", feature.name);
    if (!group.empty()) writer.member("group", group);
    if (!feature.switch_name.empty()) writer.member("switch", feature.switch_name);
    writer.member("on", feature.on).end_object();
  };
  for (const tags::Settings::Feature& feature : rig.settings.features) {
    if (!feature.group.empty() || !has_feature(other, feature.name)) {
      add(feature, feature.group);
      continue;
    }
    for (const std::string& group : local_groups(rig)) add(feature, group);
  }
}

std::string settings_text(const Rig& into, const Rig& from) {
  json::Writer writer;
  writer.begin_object().member("rest", into.settings.rest);
  if (!into.settings.features.empty() || !from.settings.features.empty()) {
    writer.key("features").begin_array();
    add_features(into, from, writer);
    add_features(from, into, writer);
    writer.end_array();
  }
  if (!into.settings.groups.empty() || !from.settings.groups.empty()) {
    writer.key("groups").begin_array();
    for (const Rig* rig : {&into, &from})
      for (const auto& [name, on] : rig->settings.groups)
        writer.begin_object().member("name", name).member("on", on).end_object();
    writer.end_array();
  }
  if (into.settings.split_weights || from.settings.split_weights)
    writer.member("split_weights", true);
  return writer.end_object().take();
}

std::string owned_text(const Value& a, const Value& b) {
  json::Writer writer;
  writer.begin_object();
  for (const char* part : {"stays", "goes"}) {
    writer.key(part).begin_object();
    for (const char* array :
         {"nodes", "meshes", "materials", "skins", "accessors", "bufferViews"}) {
      const Value mine = a[part][array], theirs = b[part][array];
      if (!mine && !theirs) continue;
      writer.key(array).begin_array();
      for (const Value& runs : {mine, theirs})
        for (const Value& number : runs.items()) writer.raw(number.text());
      writer.end_array();
    }
    writer.end_object();
  }
  return writer.end_object().take();
}

/// Of two rigs, at least one of which changed skins.
std::string rebound_text(const Value& a, const Value& b) {
  json::Writer writer;
  writer.begin_object();
  for (const char* list : {"skins", "primitives"}) {
    writer.key(list).begin_array();
    for (const Value& rebound : {a, b})
      for (const Value& item : rebound[list].items()) writer.raw(item.text());
    writer.end_array();
  }
  return writer.end_object().take();
}

/// Nodes of the first rig: a joint that lists its children lists those that come too.
void list_children(const Joining& joining, const Moved& moved, std::int64_t before, Edits& edits) {
  const Rig& into = joining.into.rig;
  std::map<std::uint32_t, std::string> more;
  for (const auto& [id, place] : moved.nodes) {
    const auto& joint = into.skeleton.joints[static_cast<std::size_t>(place.first)];
    more[joint_node(into, joint.key).index] += ',' + std::to_string(before + id.index);
  }
  const auto nodes = joining.into.item["nodes"].items();
  for (const auto& [node, text] : more) {
    const Value children = node < nodes.size() ? nodes[node]["children"] : Value();
    if (!children) continue;
    std::string list(children.text());
    list.pop_back();
    edits.replace(children, list + (children.size() == 0 ? text.substr(1) : text) + "]");
  }
  edits.sort();
}

}  // namespace

std::string joined_text(const Joining& joining, const Moved& moved) {
  const Value into = joining.into.item, from = joining.from.item;
  const auto count = [&](const char* list) { return static_cast<std::int64_t>(into[list].size()); };
  const Counts counts{count("joints"), count("nodes"), count("commands"), count("files"),
                      count("templates")};
  FromText text(joining, moved, counts);
  text.run();
  Edits children;
  list_children(joining, moved, counts.nodes, children);
  const json::Document nodes = parsed(children.text(into["nodes"]));

  Splice whole(into);
  for (const char* list : {"templates", "files", "orphans"})
    if (from[list].size() != 0)
      whole.set(list, both_lists(into[list], from[list], text.edits, false));
  whole.set("joints", both_lists(into["joints"], from["joints"], text.edits, true));
  whole.set("commands", both_lists(into["commands"], from["commands"], text.edits, true));
  whole.set("nodes", both_lists(nodes.root(), from["nodes"], text.edits, true));
  for (const char* list : {"modules", "module_pins", "features", "shapes", "groups"})
    if (from[list].size() != 0) whole.set(list, united(into[list], from[list]));
  whole.set("settings", settings_text(joining.into.rig, joining.from.rig));
  whole.set("owned", owned_text(into["owned"], from["owned"]));
  if (from["rebound"]) whole.set("rebound", rebound_text(into["rebound"], from["rebound"]));
  return whole.text();
}

}  // namespace rigc::gltf
