// SPDX-License-Identifier: MIT
// Makes channels of a motion. Test: tests/bake/bake_test.cpp
#include "bake/tracks.h"

#include <algorithm>
#include <cmath>

namespace rigc::bake {
namespace {

constexpr double kNoise = 1e-7;  // of the character's size, of a scale
constexpr double kRotationNoise =
    2e-7;  // of a quaternion's number: rounding to floats and normalising

/// Largest distance of a body from the origin of the rig, at rest: what translations are measured
/// by.
double size_of(const scene::Scene& scene, const std::vector<Body>& bodies) {
  double size = 0;
  for (const Body& body : bodies)
    size = std::max(size, math::length(scene.rest_world(body.id).origin));
  return size;
}

bool differ(const math::Vec3& a, const math::Vec3& b, double noise) {
  return std::abs(a.x - b.x) > noise || std::abs(a.y - b.y) > noise || std::abs(a.z - b.z) > noise;
}

bool differ(const math::Quat& a, const math::Quat& b, double noise) {
  return std::abs(a.x - b.x) > noise || std::abs(a.y - b.y) > noise ||
         std::abs(a.z - b.z) > noise || std::abs(a.w - b.w) > noise;
}

float* write(const math::Vec3& v, float* to) {
  for (std::size_t i = 0; i < 3; ++i) *to++ = static_cast<float>(v[i]) + 0.0f;  // no negative zeros
  return to;
}

float* write(const math::Quat& q, float* to) {
  for (const double n : {q.x, q.y, q.z, q.w}) *to++ = static_cast<float>(n) + 0.0f;
  return to;
}

/// Of a body's translations: the size as the body's parent sees it. `parent`: its world.
double translation_noise(const Body& body, const math::Affine& parent, const math::Vec3& first,
                         double size) {
  const double scale = math::length(parent.linear.x);
  const double own = std::max(math::length(body.standing.translation), math::length(first));
  return kNoise * std::max(scale > 0 ? size / scale : 0, own);
}

/// Appends the track of one path of a body, if it needs one.
template <class T>
void add_track(std::size_t body, anim::Path path, const T& standing, const Series<T>& series,
               double noise, std::vector<Track>& out) {
  const std::vector<T>& values = series.values;
  const bool moves = std::any_of(values.begin() + 1, values.end(),
                                 [&](const T& value) { return differ(value, values[0], noise); });
  if (!moves && !differ(values[0], standing, noise)) return;
  Track& track = out.emplace_back();
  track = {body, path, path == anim::Path::rotation ? 4 : 3, {}, {}, !moves};
  const std::size_t count = moves ? values.size() : 1;
  track.values.resize(count * static_cast<std::size_t>(track.width));
  float* to = track.values.data();
  for (std::size_t i = 0; i < count; ++i) to = write(values[i], to);
}

}  // namespace

std::vector<Track> find_tracks(const scene::Scene& scene, const std::vector<Body>& bodies,
                               const Motion& motion, Threads& threads) {
  const double size = size_of(scene, bodies);
  const std::vector<math::Affine> worlds = worlds_at(bodies, motion, 0);
  std::vector<std::vector<Track>> of_bodies(bodies.size());
  threads.for_each(bodies.size(), [&](std::size_t b) {
    const Body& body = bodies[b];
    if (!body.is_output) return;
    const Moves& moves = motion.bodies[b];
    math::Affine parent = body.between;
    if (body.base >= 0) parent = worlds[static_cast<std::size_t>(body.base)] * parent;
    const double noise = translation_noise(body, parent, moves.translation[0], size);
    std::vector<Track>& out = of_bodies[b];
    add_track(b, anim::Path::translation, body.standing.translation, moves.translation, noise, out);
    add_track(b, anim::Path::rotation, math::normalised(body.standing.rotation), moves.rotation,
              kRotationNoise, out);
    add_track(b, anim::Path::scale, body.standing.scale, moves.scale, kNoise, out);
  });
  std::vector<Track> tracks;
  for (std::vector<Track>& some : of_bodies)
    for (Track& track : some) tracks.push_back(std::move(track));
  return tracks;
}

anim::Curve curve_of(const Track& track, const std::shared_ptr<const std::vector<float>>& times) {
  anim::Curve curve;
  curve.width = track.width;
  if (track.constant) {
    curve.times = std::make_shared<std::vector<float>>(1, times->front());
    curve.values = track.values;
    return curve;
  }
  if (track.keys.empty()) {
    curve.times = times;
    curve.values = track.values;
    return curve;
  }
  const auto width = static_cast<std::size_t>(track.width);
  std::vector<float> key_times;
  for (const std::uint32_t key : track.keys) {
    key_times.push_back((*times)[key]);
    const auto first = track.values.begin() + static_cast<std::ptrdiff_t>(key * width);
    curve.values.insert(curve.values.end(), first, first + static_cast<std::ptrdiff_t>(width));
  }
  curve.times = std::make_shared<std::vector<float>>(std::move(key_times));
  return curve;
}

}  // namespace rigc::bake
