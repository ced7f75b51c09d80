// SPDX-License-Identifier: MIT
// Makes the channels of a transfer. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_write.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "bake/tracks.h"
#include "bake/transfer_times.h"

namespace rigc::bake {
namespace {

using scene::NodeId;
using scene::Plug;

float number_of(const math::Trs& trs, anim::Path path, std::size_t i) {
  const math::Quat& q = trs.rotation;
  const math::Vec3& v = path == anim::Path::translation ? trs.translation : trs.scale;
  const double rotation[4] = {q.x, q.y, q.z, q.w};
  const double number = path == anim::Path::rotation ? rotation[i] : v[i];
  return static_cast<float>(number) + 0.0f;  // no negative zeros
}

/// Makes the channels of a transfer.
class Writer {
 public:
  explicit Writer(const WriteInput& input)
      : scene_(input.scene), nodes_(input.nodes), aims_(input.aims), clip_(input.clip) {
    steps_ = only_steps(aims_);
    std::vector<float> keys;
    for (const double time : input.times) keys.push_back(static_cast<float>(time));
    first_ = std::make_shared<const std::vector<float>>(1, keys.front());
    times_ = std::make_shared<const std::vector<float>>(std::move(keys));
    out_.clip.name = clip_.name;
    out_.clip.source_animation = clip_.source_animation;
  }

  void add(const Unknown& u, const std::vector<math::Trs>& locals) {
    for (const anim::Path path : kPaths)
      if (solves(u, path)) add_path(u, path, locals);
  }

  void add(const SwitchValue& value) { write_numbers(value.attribute, {value.value}); }

  void add_number(const Unknown& u, const std::vector<double>& numbers) {
    const auto is_at = [&](double value) {
      return std::all_of(numbers.begin(), numbers.end(), [&](double n) { return n == value; });
    };
    if (is_at(scene_.number(u.attribute))) return drop_key(u.attribute);
    write_numbers(u.attribute,
                  is_at(numbers.front()) ? std::vector<double>{numbers.front()} : numbers);
  }

  /// What the rig drives of joints, and what it has at rest anyway, needs no channel.
  Transferred finish(TransferReport& report) {
    for (const Aim& aim : aims_)
      if (is_solved(scene_, aim)) drop(nodes_[aim.id.index], aim.id);
    for (const NodeId id : keyed_)
      if (scene_[id].kind != scene::Kind::joint) ++report.controls;
    report.kept.assign(kept_.begin(), kept_.end());
    report.channels = out_.clip.channels.size();
    for (const anim::Channel& channel : out_.clip.channels)
      report.keys += channel.curve.times->size();
    return std::move(out_);
  }

 private:
  void drop(int node, NodeId id) {
    for (const anim::Channel& channel : clip_.channels) {
      const bool stays = passed_.contains({id, channel.path});
      const bool transforms = channel.path <= anim::Path::scale;
      if (channel.node == node && transforms && !stays && !channel.baked)
        out_.dropped.push_back(channel.source_channel);
    }
  }

  void drop_key(NodeId id, anim::Path path) {
    for (const anim::Channel& channel : clip_.channels)
      if (channel.node == nodes_[id.index] && channel.path == path)
        out_.dropped.push_back(channel.source_channel);
  }

  void drop_key(const Plug& attribute) {
    for (const anim::Channel& channel : clip_.channels)
      if (channel.node == nodes_[attribute.node.index] && channel.attribute == name_of(attribute))
        out_.dropped.push_back(channel.source_channel);
  }

  const std::string& name_of(const Plug& attribute) const {
    return scene_[attribute.node].user[attribute.attribute - scene::kUserAttributes].name;
  }

  /// One for each key, or one.
  void write_numbers(const Plug& attribute, const std::vector<double>& numbers) {
    anim::Channel& channel = out_.clip.channels.emplace_back();
    channel.node = nodes_[attribute.node.index];
    channel.path = anim::Path::attribute;
    channel.attribute = name_of(attribute);
    channel.curve.times = numbers.size() == times_->size() ? times_ : first_;
    for (const double number : numbers)
      channel.curve.values.push_back(static_cast<float>(number) + 0.0f);
    if (steps_) channel.curve.interpolation = anim::Interpolation::step;
    keyed_.insert(attribute.node);
  }

  void add_path(const Unknown& u, anim::Path path, const std::vector<math::Trs>& locals) {
    const math::Trs rest = scene_.local(u.node);
    const auto is_at = [&](const math::Trs& value) {
      return std::all_of(locals.begin(), locals.end(),
                         [&](const math::Trs& local) { return differ(local, value, path) == 0; });
    };
    const bool joint = u.rule == Unknown::Rule::own;
    if (is_at(rest)) {
      if (!joint) drop_key(u.node, path);
      return;
    }
    if (joint) kept_.insert(u.node);
    if (!joint) keyed_.insert(u.node);
    const Aim* aim = joint ? &aims_[static_cast<std::size_t>(u.turn_aim)] : nullptr;
    if (aim && aim->direct && curve_on(*aim, path)) {
      passed_.insert({u.node, path});
      return;
    }
    write(u.node, path, locals, is_at(locals.front()));
  }

  void write(NodeId node, anim::Path path, const std::vector<math::Trs>& locals, bool constant) {
    Track track{0, path, path == anim::Path::rotation ? 4 : 3, {}, {}, constant};
    const std::size_t frames = constant ? 1 : locals.size();
    for (std::size_t f = 0; f < frames; ++f)
      for (std::size_t i = 0; i < static_cast<std::size_t>(track.width); ++i)
        track.values.push_back(number_of(locals[f], path, i));
    anim::Channel& channel = out_.clip.channels.emplace_back();
    channel.node = nodes_[node.index];
    channel.path = path;
    channel.curve = curve_of(track, times_);
    if (constant) channel.curve.times = first_;
    if (steps_) channel.curve.interpolation = anim::Interpolation::step;
  }

  const scene::Scene& scene_;
  const std::vector<int>& nodes_;
  const std::vector<Aim>& aims_;
  const anim::Clip& clip_;
  bool steps_ = false;
  std::shared_ptr<const std::vector<float>> times_, first_;
  std::set<NodeId> keyed_, kept_;
  std::set<std::pair<NodeId, anim::Path>> passed_;  // channels of joints that stay as they are
  Transferred out_;
};

/// Which of a clip's channels stay after a transfer.
class Stays {
 public:
  explicit Stays(const Transferred& transferred)
      : dropped_(transferred.dropped.begin(), transferred.dropped.end()) {
    for (const anim::Channel& channel : transferred.clip.channels)
      replaced_.emplace(channel.node, channel.path, channel.attribute);
  }
  bool operator()(const anim::Channel& channel) const {
    return !dropped_.contains(channel.source_channel) &&
           !replaced_.contains({channel.node, channel.path, channel.attribute});
  }

 private:
  std::set<int> dropped_;
  std::set<std::tuple<int, anim::Path, std::string>> replaced_;
};

}  // namespace

Transferred write_channels(const WriteInput& input, TransferReport& report) {
  Writer writer(input);
  for (const SwitchValue& value : input.switches) writer.add(value);
  for (std::size_t i = 0; i < input.plan.unknowns.size(); ++i) {
    const Unknown& u = input.plan.unknowns[i];
    if (is_number(u))
      writer.add_number(u, input.solution.numbers[i]);
    else
      writer.add(u, input.solution.locals[i]);
  }
  return writer.finish(report);
}

std::vector<NodeId> replaced_controls(const scene::Scene& scene, const std::vector<int>& nodes,
                                      const anim::Clip& clip, const Transferred& transferred) {
  const Stays stays(transferred);
  std::set<int> touched;
  for (const anim::Channel& channel : clip.channels)
    if (!stays(channel)) touched.insert(channel.node);
  std::vector<NodeId> controls;
  for (const NodeId id : scene.nodes())
    if (scene[id].kind == scene::Kind::control && touched.contains(nodes[id.index]))
      controls.push_back(id);
  return controls;
}

anim::Clip changed(const anim::Clip& clip, const Transferred& transferred) {
  const Stays stays(transferred);
  anim::Clip out = transferred.clip;
  for (const anim::Channel& channel : clip.channels)
    if (stays(channel)) out.channels.push_back(channel);
  return out;
}

}  // namespace rigc::bake
