// SPDX-License-Identifier: MIT
// Carries keys over. Test: tests/pipeline/update_test.cpp
#include "pipeline/carry.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/trace.h"
#include "scene/edit.h"
#include "update/skeleton.h"

namespace rigc::pipeline {
namespace {

using anim::Path;
using scene::NodeId;
using scene::Plug;
using update::Destination;
using update::Property;
namespace transform = scene::transform;

Property property_of(const anim::Channel& channel) { return {channel.path, channel.attribute}; }

Property property_of(const scene::Scene& scene, const Plug& plug) {
  if (plug.attribute >= scene::kUserAttributes)
    return {Path::attribute, scene[plug.node].user[plug.attribute - scene::kUserAttributes].name};
  return {plug.attribute == transform::kRotation ? Path::rotation
          : plug.attribute == transform::kScale  ? Path::scale
                                                 : Path::translation,
          {}};
}

std::string name_of(const Property& property) {
  switch (property.path) {
    case Path::translation:
      return "translation";
    case Path::rotation:
      return "rotation";
    case Path::scale:
      return "scale";
    case Path::weights:
      return "weights";
    case Path::attribute:
      break;
  }
  return property.attribute;
}

void set_value(scene::Scene& scene, const Plug& plug, const scene::Value& value) {
  scene::Journal journal;
  scene::Edit(scene, journal, nullptr).set(plug, value);
}

/// The transform of an orphan, one property of it.
void set_local(math::Trs& local, Path path, const scene::Value& value) {
  if (path == Path::translation) local.translation = std::get<math::Vec3>(value);
  if (path == Path::rotation) local.rotation = std::get<math::Quat>(value);
  if (path == Path::scale) local.scale = std::get<math::Vec3>(value);
}

}  // namespace

std::string describe(const Identifiers& ids, const std::string& module, const Identity& identity,
                     const std::string& name) {
  std::string text = ids.local;
  if (!ids.label.empty()) text += "." + ids.label;
  if (text.empty()) text = name;
  if (module.empty()) return text;
  text += "/" + module;
  if (identity.command != module) text += "#" + identity.command;
  text += "." + identity.role;
  return text;
}

Carrier::Carrier(const gltf::Rig& old, gltf::Rig& fresh, const std::vector<anim::Clip>& clips,
                 const std::set<int>& used, const catalog::Catalogue& catalogue,
                 update::Options options)
    : old_(old),
      fresh_(fresh),
      clips_(clips),
      used_(used),
      catalogue_(catalogue),
      options_(std::move(options)),
      built_(gltf::built_scene(old)),
      sources_(update::sources_of(built_)) {
  for (const gltf::Orphan& orphan : old.orphans)
    sources_.push_back({orphan.identity,
                        orphan.name,
                        orphan.ids,
                        orphan.kind,
                        orphan.module,
                        {orphan.space, orphan.rest},
                        {}});
  matches_ = update::match(sources_, fresh.scene, fresh.skeleton, catalogue);
  orphans_.assign(sources_.size(), -1);
  source_node_taken_.assign(sources_.size(), false);
  remap_.emplace(sources_, matches_, built_, fresh_.scene, options_);
}

/// The glTF node of a source; -1 for none.
int Carrier::node_of(std::size_t source) const {
  const update::Source& from = sources_[source];
  return from.node.valid() ? old_.nodes[from.node.index] : old_orphan(source).node;
}

/// Orphans are the last of the sources.
std::size_t Carrier::first_orphan() const { return sources_.size() - old_.orphans.size(); }

const gltf::Orphan& Carrier::old_orphan(std::size_t source) const {
  return old_.orphans[source - first_orphan()];
}

/// A joint of the model: it is in the file whatever the rig is.
bool Carrier::is_foreign(std::size_t source) const {
  const update::Source& from = sources_[source];
  if (!from.node.valid() || !built_[from.node].is_skeleton()) return false;
  const int joint = old_.skeleton.find(from.identity.owner);
  return joint >= 0 && old_.skeleton.joints[static_cast<std::size_t>(joint)].foreign_node >= 0;
}

void Carrier::find_places() {
  places_.assign(fresh_.scene.size(), -1);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const int node = node_of(i);
    if (node < 0) continue;
    by_node_.emplace(node, i);
    if (!matches_[i] || is_foreign(i)) continue;
    int& place = places_[matches_[i]->to.index];
    if (place >= 0) continue;
    place = node;
    source_node_taken_[i] = true;
  }
}

void Carrier::run() {
  const trace::Span span("carry keys");
  find_places();
  report_nodes();
  succeed();
  move_channels();
  move_values();
  keep_used_nodes();
}

/// The orphan that holds what a source had and the new rig does not.
int Carrier::orphan_of(std::size_t source) {
  int& index = orphans_[source];
  if (index >= 0) return index;
  const update::Source& from = sources_[source];
  gltf::Orphan orphan;
  orphan.node = source_node_taken_[source] ? -1 : node_of(source);
  orphan.identity = from.identity;
  orphan.name = from.name;
  orphan.ids = from.ids;
  orphan.kind = scene::spec(from.kind).is_transform ? from.kind : scene::Kind::transform;
  orphan.module = from.module;
  orphan.space = from.frame.space;
  orphan.rest = orphan.local = from.frame.rest;
  if (orphan.ids.global == old_.skeleton.global) orphan.ids.global = fresh_.skeleton.global;
  index = static_cast<int>(fresh_.orphans.size());
  fresh_.orphans.push_back(std::move(orphan));
  return index;
}

/// An orphan that has an attribute keeps it on its node, where channels find it.
void Carrier::hold(std::size_t source, const Property& property) {
  gltf::Orphan& orphan = fresh_.orphans[static_cast<std::size_t>(orphan_of(source))];
  if (property.path != Path::attribute) return;
  const auto same = [&](const scene::UserAttribute& one) { return one.name == property.attribute; };
  if (std::any_of(orphan.attributes.begin(), orphan.attributes.end(), same)) return;
  const update::Source& from = sources_[source];
  const std::vector<scene::UserAttribute>& had =
      from.node.valid() ? old_.scene[from.node].user : old_orphan(source).attributes;
  const auto found = std::find_if(had.begin(), had.end(), same);
  if (found == had.end()) return;
  scene::UserAttribute attribute;
  attribute.name = found->name;
  attribute.flavour = found->flavour;
  attribute.value = found->value;
  attribute.initial = found->initial;
  if (from.node.valid()) {
    const auto& built = built_[from.node].user;
    attribute.initial = std::find_if(built.begin(), built.end(), same)->value;
  }
  orphan.attributes.push_back(std::move(attribute));
}

void Carrier::count(std::size_t source, const Property& property, const Destination& destination,
                    bool keyed, bool converted) {
  const update::Source& from = sources_[source];
  const bool lost = destination.kind == Destination::Kind::none;
  const bool was_orphan = !from.node.valid();
  CarriedProperty carried;
  carried.from = describe_source(source) + "@" + name_of(property);
  if (!lost) {
    const scene::Node& node = fresh_.scene[destination.plug.node];
    carried.to = describe(node.ids, node.module, node.identity, node.name) + "@" +
                 (property.path == Path::attribute ? destination.attribute : name_of(property));
    carried.rule = update::name_of(matches_[source]->rule);
  }
  carried.converted = converted;
  carried.returned = was_orphan && !lost;
  if (!lost && !was_orphan && !converted && carried.rule == "identity" &&
      (property.path != Path::attribute || destination.attribute == property.attribute)) {
    ++(keyed ? report_.kept_channels : report_.kept_values);
    return;
  }
  const auto [at, is_new] = changed_.emplace(carried.from, report_.changed.size());
  if (is_new) {
    report_.changed.push_back(std::move(carried));
    if (lost) ++report_.orphans;
    if (lost && !was_orphan) ++report_.new_orphans;
  }
  if (keyed) ++report_.changed[at->second].channels;
}

void Carrier::move_channels() {
  for (const bool of_orphans : {false, true}) {
    for (std::size_t c = 0; c < clips_.size(); ++c) {
      for (std::size_t i = 0; i < clips_[c].channels.size(); ++i) {
        const auto found = by_node_.find(clips_[c].channels[i].node);
        if (found != by_node_.end() && sources_[found->second].node.valid() != of_orphans)
          move_channel(c, i, found->second);
      }
    }
  }
}

void Carrier::move_channel(std::size_t clip, std::size_t index, std::size_t source) {
  const anim::Channel& channel = clips_[clip].channels[index];
  const Property property = property_of(channel);
  Move move{clip, index, remap_->find(source, property), -1, false, std::nullopt};
  report_.baked_channels += channel.baked ? 1 : 0;
  if (is_foreign(source) || move.destination.kind == Destination::Kind::foreign) {
    move.stays = true;
    if (!source_node_taken_[source] && !is_foreign(source)) orphan_of(source);
    moves_.push_back(std::move(move));
    return;
  }
  if (move.destination.kind == Destination::Kind::property &&
      !keyed_.insert({clip, move.destination.plug}).second)
    move.destination = {};
  bool converted = false;
  if (move.destination.kind == Destination::Kind::none) {
    hold(source, property);
    move.orphan = orphan_of(source);
  } else if (update::changes_values(property, move.destination, remap_->conversion(source))) {
    anim::Curve curve = channel.curve;
    converted = update::convert(curve, property, move.destination, remap_->conversion(source));
    if (!converted)
      report_.inexact.push_back(describe_source(source) + "@" + name_of(property));
    else if (curve.values != channel.curve.values)
      move.curve = std::move(curve);
  }
  if (!channel.baked) count(source, property, move.destination, true, converted);
  moves_.push_back(std::move(move));
}

void Carrier::move_value(std::size_t source, const Property& property, const scene::Value& value) {
  Destination destination = remap_->find(source, property);
  if (destination.kind == Destination::Kind::foreign) return;
  if (implied_.count({source, property.attribute}) != 0) return;
  if (destination.kind == Destination::Kind::property && !set_.insert(destination.plug).second)
    destination = {};
  if (destination.kind == Destination::Kind::none) {
    hold(source, property);
    gltf::Orphan& orphan = fresh_.orphans[static_cast<std::size_t>(orphans_[source])];
    if (property.path != Path::attribute) set_local(orphan.local, property.path, value);
    count(source, property, destination, false, false);
    return;
  }
  const update::Conversion& conversion = remap_->conversion(source);
  const auto converted = update::converted(value, property, destination, conversion);
  if (!converted) report_.inexact.push_back(describe_source(source) + "@" + name_of(property));
  const scene::Value now = converted.value_or(value);
  const scene::Value before = fresh_.scene.value(destination.plug);
  const bool is_same = now == before;
  const bool changed = !(now == value);
  count(source, property, destination, false, changed);
  if (is_same) return;
  fresh_.posed.push_back({destination.plug, before});
  set_value(fresh_.scene, destination.plug, now);
}

void Carrier::move_values() {
  std::map<NodeId, std::size_t> by_scene_node;
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].node.valid()) by_scene_node[sources_[i].node] = i;
  for (const gltf::Posed& posed : old_.posed) {
    const auto source = by_scene_node.find(posed.plug.node);
    if (source == by_scene_node.end()) continue;
    move_value(source->second, property_of(old_.scene, posed.plug), old_.scene.value(posed.plug));
  }
  for (std::size_t i = first_orphan(); i < sources_.size(); ++i) {
    const gltf::Orphan& orphan = old_orphan(i);
    if (orphan.local.translation != orphan.rest.translation)
      move_value(i, {Path::translation, {}}, orphan.local.translation);
    if (orphan.local.rotation != orphan.rest.rotation)
      move_value(i, {Path::rotation, {}}, orphan.local.rotation);
    if (orphan.local.scale != orphan.rest.scale)
      move_value(i, {Path::scale, {}}, orphan.local.scale);
    for (const scene::UserAttribute& attribute : orphan.attributes)
      if (attribute.value != attribute.initial)
        move_value(i, {Path::attribute, attribute.name}, attribute.value);
  }
}

/// A module that takes the place of another does what that one did, whatever it does by default:
/// its descriptor says with which values (a limb that had FK alone stays at FK). What they were
/// waits for the other module's return.
void Carrier::succeed() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!matches_[i] || matches_[i]->rule != update::Rule::replaces) continue;
    const update::Source& from = sources_[i];
    const scene::Node& to = fresh_.scene[matches_[i]->to];
    if (const catalog::Descriptor* now = catalogue_.find(to.module))
      for (const auto& wanted : catalog::values_as(*now, from.module))
        set_as_before(to.identity, wanted);
    const catalog::Descriptor* before = catalogue_.find(from.module);
    if (!before || !from.node.valid()) continue;
    for (const auto& wanted : catalog::values_as(*before, to.module))
      remember(from.identity, wanted);
  }
}

/// Sets an attribute of a control that the successor's command made, unless that control was there
/// before: then it has a value of its own.
void Carrier::set_as_before(const Identity& successor, const catalog::AttributeValue& wanted) {
  for (const NodeId id : fresh_.scene.nodes()) {
    const scene::Node& node = fresh_.scene[id];
    const bool meant = node.identity.holder == successor.holder &&
                       node.identity.command == successor.command &&
                       node.identity.role == wanted.role;
    const bool was_there = std::any_of(matches_.begin(), matches_.end(),
                                       [&](const auto& match) { return match && match->to == id; });
    if (!meant || was_there) continue;
    const auto plug = fresh_.scene.find_plug(id, wanted.attribute);
    if (!plug || fresh_.scene.value(*plug) == scene::Value(wanted.value)) continue;
    fresh_.posed.push_back({*plug, fresh_.scene.value(*plug)});
    set_value(fresh_.scene, *plug, wanted.value);
    report_.set.push_back(describe(node.ids, node.module, node.identity, node.name) + "@" +
                          wanted.attribute);
  }
}

/// An attribute of a control that goes with its command, where it stood otherwise: an orphan.
void Carrier::remember(const Identity& replaced, const catalog::AttributeValue& wanted) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const update::Source& from = sources_[i];
    const bool meant = from.node.valid() && from.identity.holder == replaced.holder &&
                       from.identity.command == replaced.command &&
                       from.identity.role == wanted.role;
    if (!meant || matches_[i]) continue;
    const auto plug = built_.find_plug(from.node, wanted.attribute);
    if (!plug) continue;
    // It comes back with the module, for the same reason as it went.
    if (old_.scene.value(*plug) == scene::Value(wanted.value)) {
      implied_.emplace(i, wanted.attribute);
      continue;
    }
    if (built_.value(*plug) == scene::Value(wanted.value)) continue;
    hold(i, {Path::attribute, wanted.attribute});
    for (scene::UserAttribute& held :
         fresh_.orphans[static_cast<std::size_t>(orphans_[i])].attributes)
      if (held.name == wanted.attribute && held.value == held.initial) held.initial = wanted.value;
  }
}

/// Channels that rigc does not understand may drive a node that goes, and others may have added to
/// it: it stays for them.
void Carrier::keep_used_nodes() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const int node = node_of(i);
    if (node < 0 || matches_[i] || is_foreign(i) || used_.count(node) == 0) continue;
    orphan_of(i);
  }
}

std::string Carrier::describe_source(std::size_t source) const {
  const update::Source& from = sources_[source];
  return describe(from.ids, from.module, from.identity, from.name);
}

void Carrier::report_nodes() {
  std::vector<bool> known(fresh_.scene.size(), false);
  const double near = 1e-9 * std::max(old_.skeleton.character.height, 1e-9);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const update::Source& from = sources_[i];
    if (matches_[i]) known[matches_[i]->to.index] = true;
    if (from.kind != scene::Kind::control || !from.node.valid()) continue;
    if (!matches_[i]) {
      report_.controls_removed.push_back(describe_source(i));
      continue;
    }
    const math::Affine was = built_.rest_world(from.node);
    const math::Affine now = fresh_.scene.rest_world(matches_[i]->to);
    if (math::length(was.origin - now.origin) > near || !remap_->conversion(i).is_identity())
      report_.controls_moved.push_back(describe_source(i));
  }
  for (const NodeId id : fresh_.scene.nodes()) {
    const scene::Node& node = fresh_.scene[id];
    if (node.kind == scene::Kind::control && !known[id.index])
      report_.controls_added.push_back(describe(node.ids, node.module, node.identity, node.name));
  }
  const std::vector<int> from = update::counterparts(fresh_.skeleton, old_.skeleton);
  std::vector<bool> stays(old_.skeleton.joints.size(), false);
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] >= 0)
      stays[static_cast<std::size_t>(from[i])] = true;
    else
      report_.joints_added.push_back(fresh_.skeleton.joints[i].name);
  }
  for (std::size_t i = 0; i < stays.size(); ++i)
    if (!stays[i]) report_.joints_removed.push_back(old_.skeleton.joints[i].name);
}

std::vector<gltf::ChannelEdit> Carrier::edits() const {
  std::vector<gltf::ChannelEdit> out;
  for (const Move& move : moves_) {
    if (move.stays) continue;
    const anim::Clip& clip = clips_[move.clip];
    const anim::Channel& channel = clip.channels[move.channel];
    gltf::ChannelEdit edit;
    edit.animation = clip.source_animation;
    edit.channel = channel.source_channel;
    edit.path = channel.path;
    edit.attribute = channel.attribute;
    edit.width = channel.curve.width;
    if (move.orphan >= 0) {
      edit.node = fresh_.orphans[static_cast<std::size_t>(move.orphan)].node;
    } else {
      edit.node = fresh_.nodes[move.destination.plug.node.index];
      if (channel.path == Path::attribute) edit.attribute = move.destination.attribute;
    }
    if (move.curve) edit.values = move.curve->values;
    if (edit.node == channel.node && edit.attribute == channel.attribute && !edit.values) continue;
    out.push_back(std::move(edit));
  }
  return out;
}

}  // namespace rigc::pipeline
