// SPDX-License-Identifier: MIT
// Takes keys away within a world-space tolerance: each track is simplified by itself (Douglas and
// Peucker 1973), then all are played and measured, and simplified less while the error is too
// large. Test: tests/bake/reduce_test.cpp
#include "bake/reduce.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/trace.h"

namespace rigc::bake {
namespace {

constexpr int kAttempts = 24;
constexpr int kBetween = 3;  // times between two frames at which the error is measured
constexpr int kDeep = 48;    // cuts in cuts: more than a span of any length needs

math::Quat quaternion_at(const Track& track, std::size_t frame) {
  const float* v = &track.values[frame * 4];
  return math::normalised({static_cast<double>(v[0]), static_cast<double>(v[1]),
                           static_cast<double>(v[2]), static_cast<double>(v[3])});
}

/// Distance of a frame's value from what interpolation between two keys gives there.
double deviation(const Track& track, const std::vector<float>& times, std::size_t begin,
                 std::size_t end, std::size_t frame) {
  const auto time = [&](std::size_t f) { return static_cast<double>(times[f]); };
  const double t = (time(frame) - time(begin)) / (time(end) - time(begin));
  if (track.path == anim::Path::rotation) {
    const math::Quat between =
        math::slerp(quaternion_at(track, begin), quaternion_at(track, end), t);
    const math::Quat here = quaternion_at(track, frame);
    const math::Quat near = math::dot(between, here) < 0 ? -between : between;
    const double dx = near.x - here.x, dy = near.y - here.y, dz = near.z - here.z,
                 dw = near.w - here.w;
    return 2 * math::sqrt(dx * dx + dy * dy + dz * dz + dw * dw);  // radians, for small angles
  }
  math::Vec3 off;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto value = [&](std::size_t f) { return static_cast<double>(track.values[f * 3 + c]); };
    off[c] = value(begin) + (value(end) - value(begin)) * t - value(frame);
  }
  return math::length(off);
}

struct Span {
  std::size_t begin, end;
  int depth;
};

/// Where a span is to be cut; its begin where it need not be. Spans that come from many lopsided
/// cuts are cut in the middle, so that the work grows with n log n.
std::size_t cut_of(const Track& track, const std::vector<float>& times, double allowed,
                   const Span& span) {
  double worst = allowed;
  std::size_t at = span.begin;
  for (std::size_t frame = span.begin + 1; frame < span.end; ++frame) {
    const double off = deviation(track, times, span.begin, span.end, frame);
    if (off <= worst) continue;
    worst = off;
    at = frame;
  }
  const bool lopsided = span.depth > kDeep && at != span.begin;
  return lopsided ? (span.begin + span.end) / 2 : at;
}

std::vector<std::uint32_t> simplify(const Track& track, const std::vector<float>& times,
                                    double allowed) {
  std::vector<bool> kept(times.size(), false);
  kept.front() = kept.back() = true;
  std::vector<Span> open{{0, times.size() - 1, 0}};
  while (!open.empty()) {
    const Span span = open.back();
    open.pop_back();
    const std::size_t at = cut_of(track, times, allowed, span);
    if (at == span.begin) continue;
    kept[at] = true;
    open.push_back({span.begin, at, span.depth + 1});
    open.push_back({at, span.end, span.depth + 1});
  }
  std::vector<std::uint32_t> keys;
  for (std::size_t frame = 0; frame < kept.size(); ++frame)
    if (kept[frame]) keys.push_back(static_cast<std::uint32_t>(frame));
  return keys;
}

void simplify_all(const std::vector<Reach>& reach, const std::vector<float>& times, double share,
                  Threads& threads, std::vector<Track>& tracks) {
  threads.for_each(tracks.size(), [&](std::size_t i) {
    Track& track = tracks[i];
    if (track.constant) return;
    const Reach& r = reach[track.body];
    const double unit =
        track.path == anim::Path::translation ? r.scale : std::max(r.subtree, 1e-12);
    track.keys = simplify(track, times, share / unit);
  });
}

/// A track's curve with all frames, and with its keys.
struct Part {
  anim::Path path;
  const anim::Curve* all;
  anim::Curve reduced;
};

/// Plays the tracks as a glTF player would, all their frames and only their keys, and compares.
class Comparison {
 public:
  Comparison(const std::vector<Body>& bodies, const Motion& motion, const std::vector<Reach>& reach,
             const std::vector<float>& times, const std::vector<Track>& tracks,
             const std::vector<anim::Curve>& all)
      : bodies_(bodies), motion_(motion), reach_(reach), times_(times), parts_(bodies.size()) {
    for (std::size_t i = 0; i < tracks.size(); ++i)
      parts_[tracks[i].body].push_back(
          {tracks[i].path, &all[i], curve_of(tracks[i], all[i].times)});
  }

  /// At the frames and `between` times after each.
  double largest_error(int between, Threads& threads) const {
    std::vector<double> errors((times_.size() + kRangeFrames - 1) / kRangeFrames, 0.0);
    threads.for_each(errors.size(), [&](std::size_t range) {
      const std::size_t begin = range * kRangeFrames;
      const std::size_t end = std::min(begin + kRangeFrames, times_.size());
      errors[range] = Play(*this).largest_error(begin, end, between);
    });
    return *std::max_element(errors.begin(), errors.end());
  }

 private:
  static constexpr std::size_t kRangeFrames = 64;

  /// Both ways of playing, in rising times.
  class Play {
   public:
    explicit Play(const Comparison& of)
        : of_(of), all_(of.bodies_.size()), reduced_(of.bodies_.size()) {
      for (const std::vector<Part>& parts : of.parts_) {
        for (const Part& part : parts) {
          const bool rotation = part.path == anim::Path::rotation;
          samplers_.emplace_back(*part.all, rotation);
          samplers_.emplace_back(part.reduced, rotation);
        }
      }
    }

    double largest_error(std::size_t begin, std::size_t end, int between) {
      double largest = 0;
      for (std::size_t frame = begin; frame < end; ++frame) {
        const auto time = static_cast<double>(of_.times_[frame]);
        const bool last = frame + 1 == of_.times_.size();
        const double next = last ? time : static_cast<double>(of_.times_[frame + 1]);
        for (int i = 0; i <= (last ? 0 : between); ++i)
          largest = std::max(largest, error_at(frame, time + (next - time) * i / (between + 1)));
      }
      return largest;
    }

   private:
    double error_at(std::size_t frame, double seconds) {
      double error = 0;
      std::size_t sampler = 0;
      for (std::size_t b = 0; b < of_.bodies_.size(); ++b) {
        const Body& body = of_.bodies_[b];
        // What gets no channels is in both where it is in the frame.
        math::Trs all = body.is_output ? body.standing : of_.motion_.bodies[b][frame];
        math::Trs reduced = all;
        for (const Part& part : of_.parts_[b]) {
          sample(samplers_[sampler++], part.path, seconds, all);
          sample(samplers_[sampler++], part.path, seconds, reduced);
        }
        const auto base = static_cast<std::size_t>(std::max(body.base, 0));
        all_[b] = world_of(body, all, body.base < 0 ? nullptr : &all_[base]);
        reduced_[b] = world_of(body, reduced, body.base < 0 ? nullptr : &reduced_[base]);
        error = std::max(error, distance(reduced_[b], all_[b], of_.reach_[b]));
      }
      return error;
    }

    static void sample(anim::Sampler& sampler, anim::Path path, double seconds, math::Trs& local) {
      double n[4];
      sampler.at(seconds, n);
      if (path == anim::Path::translation) local.translation = {n[0], n[1], n[2]};
      if (path == anim::Path::rotation) local.rotation = {n[0], n[1], n[2], n[3]};
      if (path == anim::Path::scale) local.scale = {n[0], n[1], n[2]};
    }

    const Comparison& of_;
    std::vector<anim::Sampler> samplers_;  // of each part: all, reduced
    std::vector<math::Affine> all_, reduced_;
  };

  const std::vector<Body>& bodies_;
  const Motion& motion_;
  const std::vector<Reach>& reach_;
  const std::vector<float>& times_;
  std::vector<std::vector<Part>> parts_;  // by body
};

}  // namespace

double reduce(const std::vector<Body>& bodies, const std::vector<Reach>& reach,
              const Motion& motion, const std::vector<float>& times, double tolerance,
              Threads& threads, std::vector<Track>& tracks) {
  const trace::Span span("reduce");
  const auto shared = std::make_shared<const std::vector<float>>(times);
  std::vector<anim::Curve> all;
  for (const Track& track : tracks) all.push_back(curve_of(track, shared));
  double share = tolerance / 2;
  for (int attempt = 0; attempt < kAttempts && times.size() > 2; ++attempt, share /= 2) {
    simplify_all(reach, times, share, threads, tracks);
    const Comparison comparison(bodies, motion, reach, times, tracks, all);
    if (comparison.largest_error(0, threads) > tolerance) continue;
    const double largest = comparison.largest_error(kBetween, threads);
    if (largest <= tolerance) return largest;
  }
  for (Track& track : tracks) track.keys.clear();
  return 0;
}

}  // namespace rigc::bake
