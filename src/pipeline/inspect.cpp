// SPDX-License-Identifier: MIT
// Inspect: what is in a rig file. Test: tests/pipeline/inspect_test.cpp
#include "pipeline/inspect.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/codes.h"
#include "pipeline/inspect_parts.h"

namespace rigc::pipeline {
namespace {

using gltf::Rig;
using scene::NodeId;

std::vector<std::string> groups_of(const Rig& rig) {
  std::vector<std::string> groups;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints) {
    const std::string& local = joint.ids.local;
    if (!local.empty() && std::find(groups.begin(), groups.end(), local) == groups.end())
      groups.push_back(local);
  }
  return groups;
}

/// Settings of a feature in the whole rig, or in some of its groups and switches.
std::vector<tags::Settings::Feature> settings_of(const Rig& rig, const std::string& feature,
                                                 bool of_parts) {
  std::vector<tags::Settings::Feature> out;
  for (const tags::Settings::Feature& set : rig.settings.features)
    if (set.name == feature && of_parts == !(set.group.empty() && set.switch_name.empty()))
      out.push_back(set);
  return out;
}

/// Whether this rig has it: as it was set, else as its template declares it.
bool is_on(const Rig& rig, const tags::FeatureDeclaration& feature) {
  const auto whole = settings_of(rig, feature.name, false);
  return whole.empty() ? feature.on : whole.back().on;
}

void write_features(json::Writer& w, const Rig& rig) {
  w.key("features").begin_array();
  for (const tags::FeatureDeclaration& feature : rig.skeleton.features) {
    w.begin_object()
        .member("name", feature.name)
        .member("kind", feature.kind)
        .member("title", feature.title);
    w.member("on", is_on(rig, feature)).key("switches").begin_array();
    for (const std::string& name : feature.switches) w.value(name);
    w.end_array().key("set").begin_array();
    for (const tags::Settings::Feature& set : settings_of(rig, feature.name, true))
      w.begin_object()
          .member("group", set.group)
          .member("switch", set.switch_name)
          .member("on", set.on)
          .end_object();
    w.end_array().end_object();
  }
  w.end_array();
}

/// Such as "on, off in arm_l".
std::string feature_text(const Rig& rig, const tags::FeatureDeclaration& feature) {
  const auto word = [](bool on) { return on ? "on" : "off"; };
  std::string out = word(is_on(rig, feature));
  for (const tags::Settings::Feature& set : settings_of(rig, feature.name, true)) {
    out += fmt::format(", {}", word(set.on));
    if (!set.switch_name.empty()) out += fmt::format(" for {}", printable(set.switch_name));
    if (!set.group.empty()) out += fmt::format(" in {}", printable(set.group));
  }
  return out;
}

void write_joints(json::Writer& w, const Rig& rig) {
  w.key("joints").begin_array();
  for (NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (!node.is_skeleton()) continue;
    w.begin_object()
        .member("uid", to_text(node.identity.owner))
        .member("node", rig.nodes[id.index]);
    w.member("name", node.name)
        .member("local", node.ids.local)
        .member("label", node.ids.label)
        .end_object();
  }
  w.end_array();
}

void write_commands(json::Writer& w, const Rig& rig) {
  w.key("commands").begin_array();
  for (const gltf::CommandRecord& command : rig.commands) {
    w.begin_object().member("joint", command.joint).member("uid", to_text(command.holder));
    w.member("id", command.id).member("module", command.module).member("skipped", !command.ran);
    w.member("file", command.file).member("line", command.line).end_object();
  }
  w.end_array();
}

void write_rig(json::Writer& w, const Rig& rig, const gltf::ClipFile& clips) {
  w.begin_object().member("id", rig.id).member("global", rig.skeleton.global);
  const bool known = !rig.skeleton.templates.empty();
  w.key("template")
      .begin_object()
      .member("name", known ? rig.skeleton.templates.front().name : rig.skeleton.name);
  w.member("version", known ? rig.skeleton.templates.front().version : 0).end_object();
  w.key("groups").begin_array();
  for (const std::string& group : groups_of(rig)) w.value(group);
  w.end_array();
  write_features(w, rig);
  write_joints(w, rig);
  write_controls(w, rig);
  write_layers(w, rig);
  write_sets(w, rig);
  write_commands(w, rig);
  write_orphans(w, rig, clips);
  w.end_object();
}

std::string as_json(const std::vector<Rig>& rigs, const gltf::ClipFile& clips) {
  json::Writer w(2);
  w.begin_object().key("rigs").begin_array();
  for (const Rig& rig : rigs) write_rig(w, rig, clips);
  w.end_array().key("clips").begin_array();
  for (std::size_t i = 0; i < clips.clips.size(); ++i) {
    const anim::Clip& clip = clips.clips[i];
    w.begin_object().member("name", clip.name);
    w.member("duration", clip.channels.empty() ? 0.0 : anim::last_time(clip));
    w.member("channels", clip.channels.size() + static_cast<std::size_t>(clips.other_channels[i]))
        .end_object();
  }
  w.end_array().end_object();
  return w.take() + "\n";
}

std::size_t count(const Rig& rig, scene::Kind kind) {
  std::size_t n = 0;
  for (NodeId id : rig.scene.nodes()) n += rig.scene[id].kind == kind ? 1 : 0;
  return n;
}

std::string as_text(const std::vector<Rig>& rigs, const gltf::ClipFile& clips) {
  std::string out;
  for (const Rig& rig : rigs) {
    out += fmt::format("rig {} \"{}\"\n", rig.id, printable(rig.skeleton.global));
    for (const tags::TemplateReference& reference : rig.skeleton.templates) {
      out += fmt::format("  template  {} version {} ({})\n", printable(reference.name),
                         reference.version, printable(reference.file));
    }
    out +=
        fmt::format("  {} joints, {} controls, {} nodes, {} commands\n", rig.skeleton.joints.size(),
                    count(rig, scene::Kind::control), rig.scene.size(), rig.commands.size());
    out += fmt::format("  groups    {}\n", join(groups_of(rig), " "));
    for (const tags::FeatureDeclaration& feature : rig.skeleton.features) {
      out += fmt::format("  feature   {} ({}) {}\n", feature.name, feature.kind,
                         feature_text(rig, feature));
    }
    out += groups_text(rig);
    out += orphans_text(rig, clips);
  }
  if (rigs.empty()) out += "no rig\n";
  for (std::size_t i = 0; i < clips.clips.size(); ++i) {
    const anim::Clip& clip = clips.clips[i];
    out += fmt::format("clip \"{}\"  {:.3f} s, {} channels\n", printable(clip.name),
                       clip.channels.empty() ? 0.0 : anim::last_time(clip),
                       clip.channels.size() + static_cast<std::size_t>(clips.other_channels[i]));
  }
  return out;
}

}  // namespace

std::optional<std::string> inspect(const std::string& path, bool json, Diagnostics& diagnostics) {
  const auto file = gltf::open(path, diagnostics);
  if (!file) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!rigs || !clips) return std::nullopt;
  return json ? as_json(*rigs, *clips) : as_text(*rigs, *clips);
}

}  // namespace rigc::pipeline
