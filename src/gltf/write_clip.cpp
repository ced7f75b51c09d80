// SPDX-License-Identifier: MIT
// Writes clips into animations: their channels replace those with the same target, everything else
// stays. Test: tests/gltf/clips_test.cpp
#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>
#include <set>

#include "base/trace.h"
#include "gltf/clips.h"
#include "gltf/float_text.h"
#include "gltf/splice.h"
#include "gltf/uses.h"

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

/// An animation of the file with what goes from it.
class Change {
 public:
  Change(const File& file, const ClipChange& change) : clip_(change.clip) {
    if (clip_.source_animation < 0) return;
    animation_ =
        file.root()["animations"].items()[static_cast<std::size_t>(clip_.source_animation)];
    samplers_ = animation_["samplers"].items();
    used_.assign(samplers_.size(), false);
    freed_ = ours_ = used_;
    const std::set<int> drop(change.dropped_channels.begin(), change.dropped_channels.end());
    std::set<std::string> brought;
    for (const anim::Channel& channel : clip_.channels) brought.insert(target_of(channel));
    const auto channels = animation_["channels"].items();
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const bool goes =
          drop.count(static_cast<int>(i)) != 0 || brought.count(target_of(channels[i])) != 0;
      const auto sampler = static_cast<std::size_t>(channels[i]["sampler"].integer().value_or(0));
      (goes ? freed_ : used_)[sampler] = true;
      if (goes && channels[i]["extras"]["rigc"].string() == kBakedMark) ours_[sampler] = true;
      if (goes) going_.push_back(i);
    }
    for (std::size_t i = 0; i < samplers_.size(); ++i)
      if (samplers_[i]["extras"]["rigc"]["free"]) freed_[i] = true;
  }

  /// Releases the accessors of samplers that nothing uses any more.
  void release(Uses& uses, Patch& patch) const {
    for (std::size_t i = 0; i < samplers_.size(); ++i)
      for (const char* end : {"input", "output"})
        if (is_free(i))
          uses.drop_accessor(patch, static_cast<int>(samplers_[i][end].integer().value_or(-1)),
                             ours_[i]);
  }

  /// The animation with the clip's channels behind those that stay; empty where none is left.
  /// Samplers that stay keep their index: new ones take the places of those that nothing uses any
  /// more, then follow.
  std::string text(Samplers& samplers) const {
    Splice channels(animation_["channels"]);
    Splice texts(animation_["samplers"]);
    for (std::size_t i = going_.size(); i-- > 0;) channels.erase(going_[i]);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < samplers_.size(); ++i)
      if (is_free(i)) places.push_back(i);
    std::size_t next = 0;
    for (const anim::Channel& channel : clip_.channels) {
      std::size_t place = texts.size();
      if (next < places.size())
        texts.replace(place = places[next++], samplers.text(channel));
      else
        texts.append(samplers.text(channel));
      channels.append(channel_text(channel, place));
    }
    if (channels.size() == 0) return {};
    while (places.size() > next && places.back() + 1 == texts.size()) {
      texts.truncate(places.back());
      places.pop_back();
    }
    for (; next < places.size(); ++next) texts.replace(places[next], placeholder(texts, places));
    Splice whole(animation_);
    whole.set("channels", channels.text());
    whole.set("samplers", texts.text());
    return whole.text();
  }

 private:
  bool is_free(std::size_t sampler) const { return freed_[sampler] && !used_[sampler]; }

  /// A sampler whose index must stay, with the accessors of one that is used.
  std::string placeholder(const Splice& texts, const std::vector<std::size_t>& places) const {
    std::size_t used = 0;
    while (std::find(places.begin(), places.end(), used) != places.end()) ++used;
    const json::Document document = parsed(std::string(texts.value(used)));
    json::Writer writer;
    writer.begin_object().key("input").raw(document.root()["input"].text());
    writer.key("output").raw(document.root()["output"].text());
    return writer.key("extras").raw(R"({"rigc":{"free":true}})").end_object().take();
  }

  const anim::Clip& clip_;
  json::Value animation_;
  std::vector<json::Value> samplers_;
  /// By sampler: a channel that stays uses it, one that goes, one that a bake made and that goes.
  std::vector<bool> used_, freed_, ours_;
  std::vector<std::size_t> going_;  ///< channels
};

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

/// A node that gets channels cannot have a matrix: it becomes the equal translation, rotation and
/// scale.
void replace_matrix(Patch& patch, int node) {
  const json::Document document = parsed(patch.element("nodes", node));
  const auto numbers = document.root()["matrix"].items();
  if (numbers.size() != 16) return;
  double m[16];
  for (std::size_t i = 0; i < 16; ++i) m[i] = numbers[i].number().value_or(0);
  math::Affine matrix;
  matrix.linear = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
  matrix.origin = {m[12], m[13], m[14]};
  const math::Trs local = math::decompose(matrix);
  patch.set_member("nodes", node, "matrix", "");
  patch.set_member("nodes", node, "translation", float_list(&local.translation.x, 3));
  patch.set_member("nodes", node, "rotation", float_list(&local.rotation.x, 4));
  patch.set_member("nodes", node, "scale", float_list(&local.scale.x, 3));
}

}  // namespace

void write_clips(Patch& patch, const File& file, const std::vector<ClipChange>& changes) {
  const trace::Span span("write clips");
  std::vector<Change> all;
  for (const ClipChange& change : changes) all.emplace_back(file, change);
  Uses uses(file);
  for (const Change& change : all) change.release(uses, patch);
  Samplers samplers(patch);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const anim::Clip& clip = changes[i].clip;
    for (const anim::Channel& channel : clip.channels) {
      if (channel.path == anim::Path::attribute)
        patch.use_extension(kPointer);
      else if (channel.path != anim::Path::weights)
        replace_matrix(patch, channel.node);
    }
    if (clip.source_animation >= 0)
      patch.replace("animations", clip.source_animation, all[i].text(samplers));
    else if (!clip.channels.empty())
      patch.append("animations", fresh(clip, samplers));
  }
}

}  // namespace rigc::gltf
