// SPDX-License-Identifier: MIT
// Edits channels in place. Test: tests/gltf/channels_test.cpp
#include "gltf/channels.h"

#include <cstring>
#include <map>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/clips.h"
#include "gltf/splice.h"
#include "gltf/uses.h"

namespace rigc::gltf {
namespace {

using json::Value;

constexpr std::string_view kPointer = "KHR_animation_pointer";

std::size_t sampler_of(const Value& channel) {
  return static_cast<std::size_t>(channel["sampler"].integer().value_or(0));
}

std::string_view property_name(anim::Path path) {
  return path == anim::Path::rotation ? "rotation"
         : path == anim::Path::scale  ? "scale"
                                      : "translation";
}

std::string pointer_of(const ChannelEdit& edit) {
  const std::string node = "/nodes/" + std::to_string(edit.node) + "/";
  if (edit.path != anim::Path::attribute) return node + std::string(property_name(edit.path));
  return node + "extras/" + pointer_escaped(edit.attribute);
}

/// A channel's text that drives what the edit says.
std::string retargeted(const Value& channel, const ChannelEdit& edit) {
  const Value target = channel["target"];
  const std::string text(target.text());
  std::string changed;
  if (target["path"].string() == "pointer") {
    const Value extensions = target["extensions"];
    const std::string pointer = with_member(std::string(extensions[kPointer].text()), "pointer",
                                            json::quote(pointer_of(edit)));
    changed = with_member(text, "extensions",
                          with_member(std::string(extensions.text()), kPointer, pointer));
  } else {
    changed = with_member(text, "node", std::to_string(edit.node));
  }
  return with_member(std::string(channel.text()), "target", changed);
}

int append_output(Patch& patch, const ChannelEdit& edit) {
  NewAccessor accessor;
  accessor.data.resize(edit.values->size() * sizeof(float));
  std::memcpy(accessor.data.data(), edit.values->data(), accessor.data.size());
  accessor.type = edit.width == 1 ? "SCALAR" : edit.width == 3 ? "VEC3" : "VEC4";
  accessor.count = edit.values->size() / static_cast<std::size_t>(edit.width);
  return patch.append(std::move(accessor));
}

/// The node that a channel drives, by pointer too; -1: none.
int driven_node(const Value& channel) {
  const Value target = channel["target"];
  if (target["node"]) return static_cast<int>(target["node"].integer().value_or(-1));
  const auto pointer = target["extensions"][kPointer]["pointer"].string();
  if (!pointer || !starts_with(*pointer, "/nodes/")) return -1;
  const auto node = parse_integer(split(*pointer, '/')[2]);
  return node && *node >= 0 && *node <= INT32_MAX ? static_cast<int>(*node) : -1;
}

/// One animation with its edits.
class Editor {
 public:
  Editor(const Value& animation, std::vector<const ChannelEdit*> edits)
      : animation_(animation),
        channels_(animation["channels"].items()),
        samplers_(animation["samplers"].items()),
        edits_(std::move(edits)) {
    users_.assign(samplers_.size(), 0);
    for (const Value& channel : channels_) ++users_[sampler_of(channel)];
  }

  /// Outputs of samplers that nothing but an edited channel uses.
  void release(Patch& patch, Uses& uses) const {
    for (const ChannelEdit* edit : edits_) {
      if (!edit->values || users_[sampler_of(channel(*edit))] > 1) continue;
      const Value& sampler = samplers_[sampler_of(channel(*edit))];
      uses.drop_accessor(patch, static_cast<int>(sampler["output"].integer().value_or(-1)), false);
    }
  }

  std::string text(Patch& patch) const {
    Splice channels(animation_["channels"]), samplers(animation_["samplers"]);
    for (const ChannelEdit* edit : edits_) {
      std::string changed = retargeted(channel(*edit), *edit);
      if (edit->values) {
        const std::size_t at = sampler_of(channel(*edit));
        std::string sampler = with_member(std::string(samplers_[at].text()), "output",
                                          std::to_string(append_output(patch, *edit)));
        if (users_[at] > 1) {
          changed = with_member(changed, "sampler", std::to_string(samplers.size()));
          samplers.append(std::move(sampler));
        } else {
          samplers.replace(at, std::move(sampler));
        }
      }
      channels.replace(static_cast<std::size_t>(edit->channel), std::move(changed));
    }
    Splice whole(animation_);
    whole.set("channels", channels.text());
    whole.set("samplers", samplers.text());
    return whole.text();
  }

 private:
  const Value& channel(const ChannelEdit& edit) const {
    return channels_[static_cast<std::size_t>(edit.channel)];
  }

  Value animation_;
  std::vector<Value> channels_, samplers_;
  std::vector<const ChannelEdit*> edits_;
  std::vector<int> users_;  ///< channels by sampler
};

}  // namespace

void edit_channels(Patch& patch, const File& file, const std::vector<ChannelEdit>& edits) {
  const trace::Span span("edit channels");
  if (edits.empty()) return;
  std::map<int, std::vector<const ChannelEdit*>> by_animation;
  for (const ChannelEdit& edit : edits) by_animation[edit.animation].push_back(&edit);
  const auto animations = file.root()["animations"].items();
  std::vector<std::pair<int, Editor>> editors;
  for (auto& [index, of_one] : by_animation)
    editors.emplace_back(index,
                         Editor(animations[static_cast<std::size_t>(index)], std::move(of_one)));
  Uses uses(file);
  for (const auto& [index, editor] : editors) editor.release(patch, uses);
  for (const auto& [index, editor] : editors)
    patch.replace("animations", index, editor.text(patch));
}

std::set<int> animated_nodes(const File& file) {
  std::set<int> out;
  for (const Value& animation : file.root()["animations"].items())
    for (const Value& channel : animation["channels"].items())
      if (const int node = driven_node(channel); node >= 0) out.insert(node);
  return out;
}

std::size_t drop_channels(Patch& patch, const File& file, const std::set<int>& nodes) {
  std::vector<ClipChange> changes;
  std::size_t count = 0;
  const auto animations = file.root()["animations"].items();
  for (std::size_t i = 0; i < animations.size(); ++i) {
    ClipChange change;
    change.clip.source_animation = static_cast<int>(i);
    const auto channels = animations[i]["channels"].items();
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (nodes.count(driven_node(channels[c])))
        change.dropped_channels.push_back(static_cast<int>(c));
    count += change.dropped_channels.size();
    if (!change.dropped_channels.empty()) changes.push_back(std::move(change));
  }
  if (!changes.empty()) write_clips(patch, file, changes);
  return count;
}

}  // namespace rigc::gltf
