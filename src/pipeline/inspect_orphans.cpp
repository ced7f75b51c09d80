// SPDX-License-Identifier: MIT
// Inspect: keys and values whose node is gone. Test: tests/pipeline/rebuild_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "pipeline/carry.h"
#include "pipeline/inspect_parts.h"

namespace rigc::pipeline {
namespace {

std::size_t channels_of(const gltf::Orphan& orphan, const gltf::ClipFile& clips) {
  std::size_t count = 0;
  for (const anim::Clip& clip : clips.clips)
    count += static_cast<std::size_t>(
        std::count_if(clip.channels.begin(), clip.channels.end(),
                      [&](const anim::Channel& channel) { return channel.node == orphan.node; }));
  return count;
}

/// Attributes that channels hang on have a value too: those that differ from what was built.
bool is_set(const scene::UserAttribute& attribute) { return attribute.value != attribute.initial; }

std::vector<std::string> set_without_keys(const gltf::Orphan& orphan) {
  std::vector<std::string> names;
  if (orphan.local.translation != orphan.rest.translation) names.emplace_back("translation");
  if (orphan.local.rotation != orphan.rest.rotation) names.emplace_back("rotation");
  if (orphan.local.scale != orphan.rest.scale) names.emplace_back("scale");
  for (const scene::UserAttribute& attribute : orphan.attributes)
    if (is_set(attribute)) names.push_back(attribute.name);
  return names;
}

}  // namespace

void write_orphans(json::Writer& w, const gltf::Rig& rig, const gltf::ClipFile& clips) {
  w.key("orphans").begin_array();
  for (const gltf::Orphan& orphan : rig.orphans) {
    w.begin_object().member("identity", to_text(orphan.identity)).member("name", orphan.name);
    w.member("local", orphan.ids.local).member("label", orphan.ids.label);
    w.member("node", orphan.node).member("channels", channels_of(orphan, clips));
    const math::Trs& local = orphan.local;
    w.key("attributes").begin_object();
    if (local.translation != orphan.rest.translation)
      w.key("translate").numbers(&local.translation.x, 3);
    if (local.rotation != orphan.rest.rotation) w.key("rotation").numbers(&local.rotation.x, 4);
    if (local.scale != orphan.rest.scale) w.key("scale").numbers(&local.scale.x, 3);
    for (const scene::UserAttribute& attribute : orphan.attributes)
      if (is_set(attribute)) w.member(attribute.name, attribute.value);
    w.end_object().end_object();
  }
  w.end_array();
}

std::string orphans_text(const gltf::Rig& rig, const gltf::ClipFile& clips) {
  std::string out;
  for (const gltf::Orphan& orphan : rig.orphans) {
    const std::size_t channels = channels_of(orphan, clips);
    const std::vector<std::string> names = set_without_keys(orphan);
    out += fmt::format("  orphan    {}: {} channel{}{}\n",
                       printable(describe(orphan.ids, orphan.module, orphan.identity, orphan.name)),
                       channels, channels == 1 ? "" : "s",
                       names.empty() ? "" : ", and without keys " + printable(join(names, ", ")));
  }
  return out;
}

}  // namespace rigc::pipeline
