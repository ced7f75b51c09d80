// SPDX-License-Identifier: MIT
// Writes a clip into an animation: its channels replace those with the same target, everything else
// stays. Test: tests/gltf/clips_test.cpp
#include <cassert>
#include <cstring>
#include <map>
#include <set>

#include "gltf/clips.h"
#include "gltf/splice.h"

namespace rigc::gltf {
namespace {

constexpr std::string_view kPointer = "KHR_animation_pointer";

std::string packed(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string_view path_name(anim::Path path) {
  switch (path) {
    case anim::Path::translation:
      return "translation";
    case anim::Path::rotation:
      return "rotation";
    case anim::Path::scale:
      return "scale";
    case anim::Path::weights:
      return "weights";
    case anim::Path::attribute:
      break;
  }
  return "pointer";
}

/// What a channel drives, as a JSON pointer: node channels and pointers to the same property are
/// equal.
std::string target_of(const anim::Channel& channel) {
  const std::string node = "/nodes/" + std::to_string(channel.node) + "/";
  if (channel.path == anim::Path::attribute)
    return node + "extras/" + pointer_escaped(channel.attribute);
  return node + std::string(path_name(channel.path));
}

std::string target_of(const json::Value& channel) {
  const json::Value target = channel["target"];
  const std::string path = target["path"].string().value_or("");
  if (path == "pointer") return target["extensions"][kPointer]["pointer"].string().value_or("");
  const auto node = target["node"].integer();
  return node ? "/nodes/" + std::to_string(*node) + "/" + path : "";
}

/// Makes accessors and sampler texts; equal times are written once.
class Samplers {
 public:
  explicit Samplers(Patch& patch) : patch_(patch) {}

  std::string text(const anim::Channel& channel) {
    const anim::Curve& curve = channel.curve;
    json::Writer writer;
    writer.begin_object().member("input", input(*curve.times));
    if (curve.interpolation != anim::Interpolation::linear)
      writer.member("interpolation",
                    curve.interpolation == anim::Interpolation::step ? "STEP" : "CUBICSPLINE");
    writer.member("output", output(channel)).end_object();
    return writer.take();
  }

 private:
  int input(const std::vector<float>& times) {
    const auto known = inputs_.find(times);
    if (known != inputs_.end()) return known->second;
    NewAccessor accessor;
    accessor.data = packed(times);
    accessor.count = times.size();
    accessor.min = {times.front()};
    accessor.max = {times.back()};
    const int index = patch_.append(std::move(accessor));
    inputs_[times] = index;
    return index;
  }

  int output(const anim::Channel& channel) {
    const anim::Curve& curve = channel.curve;
    const bool scalar = channel.path == anim::Path::weights || curve.width == 1;
    assert(scalar || curve.width == 3 || curve.width == 4);
    NewAccessor accessor;
    accessor.data = packed(curve.values);
    accessor.type = scalar ? "SCALAR" : curve.width == 3 ? "VEC3" : "VEC4";
    accessor.count = curve.values.size() / static_cast<std::size_t>(scalar ? 1 : curve.width);
    return patch_.append(std::move(accessor));
  }

  Patch& patch_;
  std::map<std::vector<float>, int> inputs_;
};

std::string channel_text(const anim::Channel& channel, std::size_t sampler) {
  json::Writer writer;
  writer.begin_object().member("sampler", sampler).key("target").begin_object();
  if (channel.path == anim::Path::attribute) {
    writer.member("path", "pointer").key("extensions").begin_object().key(kPointer);
    writer.begin_object().member("pointer", target_of(channel)).end_object().end_object();
  } else {
    writer.member("node", channel.node).member("path", path_name(channel.path));
  }
  writer.end_object();
  if (channel.baked) {
    writer.key("extras").begin_object().member("rigc", kBakedMark).end_object();
  }
  writer.end_object();
  return writer.take();
}

/// Puts the clip's channels and samplers behind those of `animation` that stay. Samplers that stay
/// keep their index: new ones take the places of those that nothing uses any more, then follow.
std::string merged(const json::Value& animation, const anim::Clip& clip,
                   const std::vector<int>& dropped, Samplers& samplers) {
  const std::set<int> drop(dropped.begin(), dropped.end());
  std::set<std::string> brought;
  for (const anim::Channel& channel : clip.channels) brought.insert(target_of(channel));
  Splice channels(animation["channels"]);
  Splice texts(animation["samplers"]);
  const auto old = animation["channels"].items();
  std::vector<bool> used(texts.size(), false), freed(texts.size(), false);
  for (std::size_t i = old.size(); i-- > 0;) {
    const bool goes = drop.count(static_cast<int>(i)) != 0 || brought.count(target_of(old[i])) != 0;
    const auto sampler = static_cast<std::size_t>(old[i]["sampler"].integer().value_or(0));
    (goes ? freed : used)[sampler] = true;
    if (goes) channels.erase(i);
  }
  std::size_t place = 0;
  const auto is_free = [&](std::size_t i) { return freed[i] && !used[i]; };
  for (const anim::Channel& channel : clip.channels) {
    while (place < used.size() && !is_free(place)) ++place;
    if (place < used.size())
      texts.replace(place, samplers.text(channel));
    else
      texts.append(samplers.text(channel));
    channels.append(channel_text(channel, place++));
  }
  if (channels.size() == 0) return {};
  while (texts.size() > place && texts.size() <= used.size() && is_free(texts.size() - 1))
    texts.truncate(texts.size() - 1);
  Splice whole(animation);
  whole.set("channels", channels.text());
  whole.set("samplers", texts.text());
  return whole.text();
}

std::string fresh(const anim::Clip& clip, Samplers& samplers) {
  json::Writer writer;
  writer.begin_object();
  if (!clip.name.empty()) writer.member("name", clip.name);
  writer.key("channels").begin_array();
  for (std::size_t i = 0; i < clip.channels.size(); ++i)
    writer.raw(channel_text(clip.channels[i], i));
  writer.end_array().key("samplers").begin_array();
  for (const anim::Channel& channel : clip.channels) writer.raw(samplers.text(channel));
  writer.end_array().end_object();
  return writer.take();
}

}  // namespace

void write_clip(Patch& patch, const File& file, const anim::Clip& clip,
                const std::vector<int>& dropped_channels) {
  Samplers samplers(patch);
  for (const anim::Channel& channel : clip.channels)
    if (channel.path == anim::Path::attribute) patch.use_extension(kPointer);
  if (clip.source_animation < 0) {
    if (!clip.channels.empty()) patch.append("animations", fresh(clip, samplers));
    return;
  }
  const json::Value animation =
      file.root()["animations"].items()[static_cast<std::size_t>(clip.source_animation)];
  patch.replace("animations", clip.source_animation,
                merged(animation, clip, dropped_channels, samplers));
}

}  // namespace rigc::gltf
