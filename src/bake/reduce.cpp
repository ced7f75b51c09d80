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

/// How far a body's own change is felt: lengths in rig units at rest.
struct Reach {
  double limb = 0;  ///< to the farthest base-child, or as long as its own bone: where its rotation
                    ///< is measured
  double subtree = 0;  ///< to the farthest body below it
  double scale = 1;    ///< of its parent: a unit of its translation in rig units
};

std::vector<Reach> reaches(const scene::Scene& scene, const std::vector<Body>& bodies) {
  std::vector<Reach> out(bodies.size());
  std::vector<math::Vec3> origins;
  for (const Body& body : bodies) origins.push_back(scene.rest_world(body.id).origin);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int base = bodies[i].base;
    if (base < 0) continue;
    const auto at = static_cast<std::size_t>(base);
    const double length = math::length(origins[i] - origins[at]);
    out[i].scale = std::max(math::length(scene.rest_world(bodies[at].id).linear.x), 1e-12);
    out[at].limb = std::max(out[at].limb, length);
    out[i].limb = std::max(out[i].limb, length);  // of a leaf: as long as the bone before it
    for (int above = base; above >= 0; above = bodies[static_cast<std::size_t>(above)].base) {
      double& subtree = out[static_cast<std::size_t>(above)].subtree;
      subtree =
          std::max(subtree, math::length(origins[i] - origins[static_cast<std::size_t>(above)]));
    }
  }
  for (Reach& reach : out) reach.subtree = std::max(reach.subtree, reach.limb);
  return out;
}

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

std::vector<std::uint32_t> simplify(const Track& track, const std::vector<float>& times,
                                    double allowed) {
  std::vector<bool> kept(times.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, times.size() - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    double worst = allowed;
    std::size_t at = 0;
    for (std::size_t frame = begin + 1; frame < end; ++frame) {
      const double off = deviation(track, times, begin, end, frame);
      if (off <= worst) continue;
      worst = off;
      at = frame;
    }
    if (at == 0) continue;
    kept[at] = true;
    open.emplace_back(begin, at);
    open.emplace_back(at, end);
  }
  std::vector<std::uint32_t> keys;
  for (std::size_t frame = 0; frame < kept.size(); ++frame)
    if (kept[frame]) keys.push_back(static_cast<std::uint32_t>(frame));
  return keys;
}

void simplify_all(const std::vector<Reach>& reach, const std::vector<float>& times, double share,
                  std::vector<Track>& tracks) {
  for (Track& track : tracks) {
    if (track.constant) continue;
    const Reach& r = reach[track.body];
    const double unit =
        track.path == anim::Path::translation ? r.scale : std::max(r.subtree, 1e-12);
    track.keys = simplify(track, times, share / unit);
  }
}

/// Plays the tracks as a glTF player would and compares every body with the motion.
class Player {
 public:
  Player(const std::vector<Body>& bodies, const Motion& motion, const std::vector<float>& times,
         const std::vector<Track>& tracks)
      : bodies_(bodies), motion_(motion) {
    const auto shared = std::make_shared<const std::vector<float>>(times);
    curves_.resize(bodies.size());
    for (const Track& track : tracks)
      curves_[track.body].emplace_back(track.path, curve_of(track, shared));
    worlds_.resize(bodies.size());
  }

  double largest_error(const std::vector<Reach>& reach, const std::vector<float>& times) {
    double error = 0;
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const Body& body = bodies_[b];
        const math::Affine* base =
            body.base < 0 ? nullptr : &worlds_[static_cast<std::size_t>(body.base)];
        const math::Trs local = body.is_output ? played(b, static_cast<double>(times[frame]))
                                               : motion_.locals[b][frame];
        worlds_[b] = world_of(body, local, base);
        error = std::max(error, distance(worlds_[b], motion_.worlds[b][frame], reach[b].limb));
      }
    }
    return error;
  }

 private:
  math::Trs played(std::size_t body, double seconds) const {
    math::Trs local = bodies_[body].standing;
    for (const auto& [path, curve] : curves_[body]) {
      double n[4];
      anim::sample(curve, path == anim::Path::rotation, seconds, n);
      if (path == anim::Path::translation) local.translation = {n[0], n[1], n[2]};
      if (path == anim::Path::rotation) local.rotation = {n[0], n[1], n[2], n[3]};
      if (path == anim::Path::scale) local.scale = {n[0], n[1], n[2]};
    }
    return local;
  }

  /// Of the origin and of points on the axes, `limb` away in the rig's space.
  static double distance(const math::Affine& a, const math::Affine& b, double limb) {
    double largest = math::length(a.origin - b.origin);
    for (const auto axis : {&math::Mat3::x, &math::Mat3::y, &math::Mat3::z}) {
      const double length = math::length(b.linear.*axis);
      if (length < 1e-30) continue;
      const math::Vec3 off = (a.linear.*axis - b.linear.*axis) * (limb / length);
      largest = std::max(largest, math::length(a.origin - b.origin + off));
    }
    return largest;
  }

  const std::vector<Body>& bodies_;
  const Motion& motion_;
  std::vector<std::vector<std::pair<anim::Path, anim::Curve>>> curves_;  // by body
  std::vector<math::Affine> worlds_;
};

}  // namespace

double reduce(const scene::Scene& scene, const std::vector<Body>& bodies, const Motion& motion,
              const std::vector<float>& times, double tolerance, std::vector<Track>& tracks) {
  const trace::Span span("reduce");
  const std::vector<Reach> reach = reaches(scene, bodies);
  const auto measure = [&] {
    return Player(bodies, motion, times, tracks).largest_error(reach, times);
  };
  double share = tolerance / 2;
  for (int attempt = 0; attempt < kAttempts && times.size() > 2; ++attempt, share /= 2) {
    simplify_all(reach, times, share, tracks);
    const double error = measure();
    if (error <= tolerance) return error;
  }
  for (Track& track : tracks) track.keys.clear();
  return measure();
}

}  // namespace rigc::bake
