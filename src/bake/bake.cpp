// SPDX-License-Identifier: MIT
// Bakes a clip: what is animated, which joints follow, their motion, its channels.
// Test: tests/bake/bake_test.cpp
#include "bake/bake.h"

#include <algorithm>

#include "bake/frames.h"
#include "bake/insert.h"
#include "bake/joints.h"
#include "bake/reduce.h"

namespace rigc::bake {
namespace {

/// Only with its times, and the values of steps.
anim::Clip clip_of(const std::vector<eval::ClipInput>& inputs) {
  anim::Clip clip;
  for (const eval::ClipInput& input : inputs) {
    anim::Curve& curve = clip.channels.emplace_back().curve;
    curve.times = input.curve->times;
    if (input.curve->interpolation != anim::Interpolation::step) continue;
    curve = *input.curve;
  }
  return clip;
}

std::vector<float> as_floats(const std::vector<double>& times) {
  std::vector<float> out;
  for (const double time : times) out.push_back(static_cast<float>(time));
  return out;
}

/// Channels of all tracks; those of one key share their time.
void add_channels(const std::vector<Track>& tracks, const std::vector<Body>& bodies,
                  const std::vector<int>& nodes, std::vector<float> times, anim::Clip& out) {
  const auto all = std::make_shared<const std::vector<float>>(std::move(times));
  const auto first = std::make_shared<const std::vector<float>>(1, all->front());
  for (const Track& track : tracks) {
    anim::Channel channel;
    channel.node = nodes[bodies[track.body].id.index];
    channel.path = track.path;
    channel.curve = curve_of(track, all);
    if (track.constant) channel.curve.times = first;
    out.channels.push_back(std::move(channel));
  }
}

}  // namespace

void Shear::add(const Shear& other) {
  relative = std::max(relative, other.relative);
  if (other.distance <= distance) return;
  distance = other.distance;
  joint = other.joint;
  seconds = other.seconds;
}

std::optional<anim::Clip> bake(const scene::Scene& scene, const std::vector<int>& nodes,
                               const anim::Clip& clip, const Options& options, Report& report,
                               Diagnostics& diagnostics) {
  const std::vector<eval::ClipInput> inputs = eval::clip_inputs(scene, nodes, clip);
  const std::vector<Body> bodies =
      find_bodies(scene, nodes, animated_nodes(scene, inputs), options);
  auto times =
      frame_times(clip, clip_of(inputs), options, bodies.size() * kMotionWidth, diagnostics);
  if (!times) return std::nullopt;
  Threads alone(1);
  Threads& threads = options.threads ? *options.threads : alone;
  const std::vector<Reach> reach = reaches(scene, nodes, bodies, options);
  const auto evaluator = Evaluator::make(scene, bodies, inputs, reach, diagnostics);
  if (!evaluator) return std::nullopt;
  const bool inserts = options.fps == 0 && options.tolerance > 0;
  const double tolerance = inserts ? options.tolerance / 2 : options.tolerance;
  if (inserts)
    times = insert_frames(*evaluator, std::move(*times), tolerance, threads, diagnostics);
  if (!times) return std::nullopt;
  const auto motion = evaluator->run(std::move(*times), threads, diagnostics);
  if (!motion) return std::nullopt;
  std::vector<Track> tracks = find_tracks(scene, bodies, *motion, threads);
  std::vector<float> key_times = as_floats(motion->times);

  report.frames = std::max(report.frames, key_times.size());
  report.times = key_times;
  report.shear.add(motion->shear);
  if (tolerance > 0)
    report.reduction_error =
        std::max(report.reduction_error,
                 reduce(bodies, reach, *motion, key_times, tolerance, threads, tracks));
  for (const Body& body : bodies)
    if (body.is_output) report.driven.push_back(nodes[body.id.index]);

  anim::Clip out;
  out.name = clip.name;
  out.source_animation = clip.source_animation;
  add_channels(tracks, bodies, nodes, std::move(key_times), out);
  report.channels += out.channels.size();
  for (const anim::Channel& channel : out.channels) report.keys += channel.curve.times->size();
  return out;
}

}  // namespace rigc::bake
