// SPDX-License-Identifier: MIT
// Reads animations: node channels and pointers to node properties.
// Test: tests/gltf/clips_test.cpp
#include "gltf/clips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/accessor.h"
#include "gltf/codes.h"
#include "gltf/slim.h"

namespace rigc::gltf {
namespace {

/// The node that a pointer leads into, as it is written; empty for other pointers.
std::string_view node_step(std::string_view pointer) {
  const auto steps = split(pointer, '/');
  return steps.size() > 2 && steps[1] == "nodes" ? steps[2] : std::string_view();
}

/// Whether a pointer leads to something that may exist: what is not in a node is not read.
bool leads_somewhere(const std::optional<std::string>& pointer, std::size_t node_count) {
  if (!pointer || !starts_with(*pointer, "/")) return false;
  const std::string_view step = node_step(*pointer);
  const auto node = parse_integer(step);
  return step.empty() || (node && *node >= 0 && static_cast<std::uint64_t>(*node) < node_count);
}

/// The target of a pointer that leads somewhere, as a channel without a curve; nothing for what
/// rigc does not animate.
std::optional<anim::Channel> parse_pointer(const std::string& pointer) {
  const auto steps = split(pointer, '/');
  const auto node = parse_integer(node_step(pointer));
  if (steps.size() < 4 || !node) return std::nullopt;
  anim::Channel channel;
  channel.node = static_cast<int>(*node);
  if (steps.size() == 5 && steps[3] == "extras") {
    channel.path = anim::Path::attribute;
    channel.attribute = pointer_unescaped(steps[4]);
    return channel;
  }
  if (steps.size() != 4) return std::nullopt;
  if (steps[3] == "translation")
    channel.path = anim::Path::translation;
  else if (steps[3] == "rotation")
    channel.path = anim::Path::rotation;
  else if (steps[3] == "scale")
    channel.path = anim::Path::scale;
  else
    return std::nullopt;
  return channel;
}

int width_of(anim::Path path) {
  return path == anim::Path::attribute ? 1 : path == anim::Path::rotation ? 4 : 3;
}

class ClipReader {
 public:
  ClipReader(const File& file, const Slim& slim, Diagnostics& diagnostics)
      : file_(file), slim_(slim), diagnostics_(diagnostics) {
    // Samplers may share accessors, so that a small file can ask for any amount of memory. A number
    // takes 4 bytes here, and between 1 and 4 in the file.
    budget_ = std::uint64_t{1} << 22;
    for (const Buffer& buffer : file.buffers) budget_ += buffer.bytes.size() / 4 * 3;
  }

  ClipFile read() {
    ClipFile result;
    const auto animations = file_.root()["animations"].items();
    for (std::size_t i = 0; i < slim_.animations.size(); ++i) {
      anim::Clip clip;
      clip.name = slim_.animations[i].name;
      clip.source_animation = static_cast<int>(i);
      const auto channels = animations[i]["channels"].items();
      for (anim::Channel& channel : targets(slim_.animations[i], channels))
        if (add_curve(slim_.animations[i], channels, channel))
          clip.channels.push_back(std::move(channel));
      result.other_channels.push_back(static_cast<int>(channels.size() - clip.channels.size()));
      result.clips.push_back(std::move(clip));
    }
    return result;
  }

 private:
  /// What the channels of an animation that rigc understands drive, in the file's order.
  std::vector<anim::Channel> targets(const SlimAnimation& animation,
                                     const std::vector<json::Value>& channels) {
    std::vector<anim::Channel> result;
    for (const SlimChannel& from : animation.channels) {
      anim::Channel channel;
      channel.node = from.node;
      channel.source_channel = from.index;
      if (from.path == "weights") continue;
      channel.path = from.path == "rotation" ? anim::Path::rotation
                     : from.path == "scale"  ? anim::Path::scale
                                             : anim::Path::translation;
      result.push_back(std::move(channel));
    }
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const json::Value target = channels[i]["target"];
      if (target["path"].string() != "pointer") continue;
      const auto pointer = target["extensions"]["KHR_animation_pointer"]["pointer"].string();
      if (!leads_somewhere(pointer, slim_.nodes.size())) {
        report(codes::kPointer, target,
               fmt::format("\"{}\" leads to no node of the file",
                           printable(pointer.value_or(""), 80)));
        continue;
      }
      auto channel = parse_pointer(*pointer);
      if (!channel) continue;
      channel->source_channel = static_cast<int>(i);
      result.push_back(*std::move(channel));
    }
    std::sort(result.begin(), result.end(), [](const anim::Channel& a, const anim::Channel& b) {
      return a.source_channel < b.source_channel;
    });
    return result;
  }

  bool add_curve(const SlimAnimation& animation, const std::vector<json::Value>& channels,
                 anim::Channel& channel) {
    const json::Value value = channels[static_cast<std::size_t>(channel.source_channel)];
    const auto index = static_cast<std::size_t>(value["sampler"].integer().value_or(0));
    const SlimSampler& sampler = animation.samplers[index];
    const auto& output = slim_.accessors[static_cast<std::size_t>(sampler.output)];
    channel.baked = value["extras"]["rigc"].string() == kBakedMark;
    anim::Curve& curve = channel.curve;
    curve.interpolation = sampler.interpolation;
    curve.width = width_of(channel.path);
    const std::uint64_t keys = slim_.accessors[static_cast<std::size_t>(sampler.input)].count;
    const std::uint64_t wanted = curve.interpolation == anim::Interpolation::cubic ? 3 : 1;
    // Only pointers come here unfit: the checks know the types of the other paths. What others
    // animate in extras may have any width.
    if (output.width != curve.width || output.count / wanted != keys) {
      if (channel.path != anim::Path::attribute)
        report(codes::kSampler, value,
               fmt::format("accessor {} does not fit its target", sampler.output));
      return false;
    }
    curve.times = times(sampler.input);
    if (!curve.times || !spend(output.count * static_cast<std::uint64_t>(output.width), value))
      return false;
    auto values = read_floats(file_, slim_, sampler.output, output.count, diagnostics_);
    if (!values) return false;
    curve.values = *std::move(values);
    return channel.path != anim::Path::rotation || check_rotations(curve, sampler.output);
  }

  /// Quaternions of length zero are no rotations; tangents are none either and may have it.
  bool check_rotations(const anim::Curve& curve, int accessor) {
    const bool cubic = curve.interpolation == anim::Interpolation::cubic;
    const std::size_t stride = cubic ? 12 : 4;
    for (std::size_t i = cubic ? 4 : 0; i + 4 <= curve.values.size(); i += stride) {
      const float* q = curve.values.data() + i;
      if (std::abs(q[0]) + std::abs(q[1]) + std::abs(q[2]) + std::abs(q[3]) > 1e-6f) continue;
      diagnostics_.report(
          codes::kZeroRotation, Place(file_.path, fmt::format("/accessors/{}", accessor)),
          fmt::format("quaternion {} of accessor {} has length zero", i / stride, accessor));
      return false;
    }
    return true;
  }

  void report(const Code& code, const json::Value& at, std::string message) {
    diagnostics_.report(code, Place(file_.path, at.pointer()), std::move(message));
  }

  bool spend(std::uint64_t numbers, const json::Value& channel) {
    if (numbers <= budget_) {
      budget_ -= numbers;
      return true;
    }
    if (!overspent_)
      report(codes::kNoData, channel,
             "the animations share so much data that they do not fit into memory");
    overspent_ = true;
    return false;
  }

  std::shared_ptr<const std::vector<float>> times(int accessor) {
    const auto known = times_.find(accessor);
    if (known != times_.end()) return known->second;
    auto& shared = times_[accessor];
    auto read = read_times(file_, slim_, accessor, diagnostics_);
    if (!read) return nullptr;
    shared = std::make_shared<const std::vector<float>>(*std::move(read));
    return shared;
  }

  const File& file_;
  const Slim& slim_;
  Diagnostics& diagnostics_;
  std::uint64_t budget_;  ///< numbers that may still be read
  bool overspent_ = false;
  std::map<int, std::shared_ptr<const std::vector<float>>>
      times_;  ///< by accessor; empty: reported
};

}  // namespace

std::string pointer_unescaped(std::string_view step) {
  std::string out;
  for (std::size_t i = 0; i < step.size(); ++i) {
    const bool escape = step[i] == '~' && i + 1 < step.size();
    out += !escape ? step[i] : step[++i] == '1' ? '/' : '~';
  }
  return out;
}

std::string pointer_escaped(std::string_view step) {
  std::string out;
  for (char c : step) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
  return out;
}

std::optional<ClipFile> read_clips(const File& file, Diagnostics& diagnostics, const Slim* known) {
  const trace::Span span("read clips");
  const std::size_t errors = diagnostics.errors();
  const auto own = known ? std::nullopt : read_slim(file, diagnostics);
  if (!known && !own) return std::nullopt;
  ClipFile result = ClipReader(file, known ? *known : *own, diagnostics).read();
  if (diagnostics.errors() != errors) return std::nullopt;
  return result;
}

}  // namespace rigc::gltf
