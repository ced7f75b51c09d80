// SPDX-License-Identifier: MIT
// Transfer: what the clip plays on joints, which controls say it, their values, their channels, and
// how far the rig then is from it. Test: tests/bake/transfer_test.cpp
#include "bake/transfer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "bake/frames.h"
#include "bake/tracks.h"
#include "bake/transfer_measure.h"
#include "bake/transfer_plugs.h"
#include "bake/transfer_solve.h"

namespace rigc::bake {
namespace {

using scene::NodeId;
using scene::Plug;

/// Curves that are neither steps nor lines are sampled this often.
constexpr double kCubicRate = 60;
constexpr double kMostSamples = 1'000'000;

const anim::Curve* curve_on(const Aim& aim, anim::Path path) {
  return path == anim::Path::translation ? aim.translation
         : path == anim::Path::rotation  ? aim.rotation
                                         : aim.scale;
}

/// Curves on joints that the plan solves, or that move one which it solves.
std::vector<const anim::Curve*> curves_on(const std::vector<Aim>& aims) {
  std::vector<const anim::Curve*> curves;
  for (const Aim& aim : aims)
    for (const anim::Path path : kPaths)
      if (const anim::Curve* curve = curve_on(aim, path)) curves.push_back(curve);
  return curves;
}

void add_times(anim::Clip& clip, std::vector<float> times) {
  anim::Channel& channel = clip.channels.emplace_back();
  channel.curve.times = std::make_shared<const std::vector<float>>(std::move(times));
}

/// Before each step but the first, so that its value ends where it did.
std::vector<float> ends_of_steps(const std::vector<float>& times) {
  std::vector<float> ends;
  for (std::size_t i = 1; i < times.size(); ++i)
    ends.push_back(std::nextafter(times[i], times[i - 1]));
  return ends;
}

std::vector<float> cubic_samples(const std::vector<float>& times) {
  const auto first = static_cast<double>(times.front()), last = static_cast<double>(times.back());
  std::vector<float> samples;
  if (!((last - first) * kCubicRate <= kMostSamples)) return samples;
  for (double k = 1; first + k / kCubicRate < last; k += 1)
    samples.push_back(static_cast<float>(first + k / kCubicRate));
  return samples;
}

/// A clip with only the times that count: of the joints' keys, and where between keys a line is not
/// what plays.
anim::Clip timing(const std::vector<const anim::Curve*>& curves, bool steps) {
  anim::Clip clip;
  for (const anim::Curve* curve : curves) {
    clip.channels.emplace_back().curve.times = curve->times;
    if (curve->interpolation == anim::Interpolation::step && !steps && curve->times->size() > 1)
      add_times(clip, ends_of_steps(*curve->times));
    if (curve->interpolation == anim::Interpolation::cubic && curve->times->size() > 1)
      add_times(clip, cubic_samples(*curve->times));
  }
  std::erase_if(clip.channels, [](const anim::Channel& c) { return c.curve.times->empty(); });
  return clip;
}

/// Whether the rig or the transfer says where a joint is: then its channels go, or come again.
bool is_solved(const scene::Scene& scene, const Aim& aim) {
  return is_driven(scene, aim.id) || (aim.animated() && !aim.direct);
}

/// What the clip moves besides what is solved or switched.
std::vector<eval::ClipInput> other_inputs(const scene::Scene& scene, const std::vector<Aim>& aims,
                                          const std::vector<eval::ClipInput>& all,
                                          const TransferPlan& plan,
                                          const std::vector<SwitchValue>& switches) {
  std::set<Plug> taken;
  for (const SwitchValue& value : switches) taken.insert(value.attribute);
  for (const Unknown& u : plan.unknowns) {
    if (u.rule == Unknown::Rule::twist) taken.insert(u.attribute);
    for (const anim::Path path : kPaths)
      if (solves(u, path)) taken.insert(plug_of(u.node, path));
  }
  for (const Aim& aim : aims)
    for (const anim::Path path : kPaths)
      if (is_solved(scene, aim)) taken.insert(plug_of(aim.id, path));
  std::vector<eval::ClipInput> others;
  for (const eval::ClipInput& input : all)
    if (!taken.contains(input.plug)) others.push_back(input);
  return others;
}

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
  Writer(const scene::Scene& scene, const std::vector<int>& nodes, const std::vector<Aim>& aims,
         const anim::Clip& clip, const std::vector<double>& times, bool steps)
      : scene_(scene), nodes_(nodes), aims_(aims), clip_(clip) {
    steps_ = steps;
    std::vector<float> keys;
    for (const double time : times) keys.push_back(static_cast<float>(time));
    first_ = std::make_shared<const std::vector<float>>(1, keys.front());
    times_ = std::make_shared<const std::vector<float>>(std::move(keys));
    out_.clip.name = clip.name;
    out_.clip.source_animation = clip.source_animation;
  }

  void add(const Unknown& u, const std::vector<math::Trs>& locals) {
    for (const anim::Path path : kPaths)
      if (solves(u, path)) add_path(u, path, locals);
  }

  void add(const SwitchValue& value) { write_numbers(value.attribute, {value.value}); }

  void add_twist(const Unknown& u, const std::vector<double>& numbers) {
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

/// The clip as it is after the transfer.
anim::Clip changed(const anim::Clip& clip, const Transferred& transferred) {
  const std::set<int> dropped(transferred.dropped.begin(), transferred.dropped.end());
  std::set<std::tuple<int, anim::Path, std::string>> replaced;
  for (const anim::Channel& channel : transferred.clip.channels)
    replaced.emplace(channel.node, channel.path, channel.attribute);
  anim::Clip out = transferred.clip;
  for (const anim::Channel& channel : clip.channels)
    if (!dropped.contains(channel.source_channel) &&
        !replaced.contains({channel.node, channel.path, channel.attribute}))
      out.channels.push_back(channel);
  return out;
}

/// Joints that the clip animates and the rig drives.
std::size_t concerned(const scene::Scene& scene, const std::vector<Aim>& aims) {
  return static_cast<std::size_t>(std::count_if(aims.begin(), aims.end(), [&](const Aim& aim) {
    return aim.animated() && is_driven(scene, aim.id);
  }));
}

}  // namespace

std::optional<Transferred> transfer(const scene::Scene& scene, const std::vector<int>& nodes,
                                    const anim::Clip& clip, const TransferOptions& options,
                                    TransferReport& report, Diagnostics& diagnostics) {
  const std::vector<Aim> aims = find_aims(scene, nodes, clip, options.standings);
  report.joints = concerned(scene, aims);
  if (report.joints == 0) return Transferred{{clip.name, clip.source_animation, {}}, {}};
  const std::vector<const anim::Curve*> curves = curves_on(aims);
  const bool steps = std::all_of(curves.begin(), curves.end(), [](const anim::Curve* curve) {
    return curve->interpolation == anim::Interpolation::step;
  });
  const auto plan = make_plan(scene, nodes, aims, options.switches, diagnostics);
  if (!plan) return std::nullopt;

  Options timed;
  timed.fps = options.fps;
  timed.start = options.start;
  timed.end = options.end;
  const anim::Clip keys = timing(curves, steps);
  const std::size_t width = 24 * aims.size() + 10 * plan->unknowns.size();
  const auto times = frame_times(keys, keys, timed, width, diagnostics);
  if (!times) return std::nullopt;

  const auto all = eval::clip_inputs(scene, nodes, clip);
  const auto others = other_inputs(scene, aims, all, *plan, options.switches);
  const auto worlds = play(aims, *times);
  const auto solution =
      solve(scene, {*plan, aims, worlds, others, options.switches, *times}, diagnostics);
  if (!solution) return std::nullopt;

  Writer writer(scene, nodes, aims, clip, *times, steps);
  for (const SwitchValue& value : options.switches) writer.add(value);
  for (std::size_t i = 0; i < plan->unknowns.size(); ++i) {
    const Unknown& u = plan->unknowns[i];
    if (u.rule == Unknown::Rule::twist)
      writer.add_twist(u, solution->numbers[i]);
    else
      writer.add(u, solution->locals[i]);
  }
  Transferred out = writer.finish(report);
  report.frames = times->size();
  Measure measure{scene, nodes, aims, options.standings, changed(clip, out), -1};
  for (const anim::Channel& channel : out.clip.channels)
    if (channel.curve.times->size() > 1 && channel.path <= anim::Path::scale)
      measure.keyed_node = channel.node;
  if (!measure_deviation(measure, *times, report, diagnostics)) return std::nullopt;
  return out;
}

}  // namespace rigc::bake
