// SPDX-License-Identifier: MIT
// Makes channels of a motion. Test: tests/bake/tracks_test.cpp
#include "bake/tracks.h"

#include <algorithm>
#include <array>
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

using Numbers = std::array<double, 4>;

Numbers numbers_of(const math::Trs& trs, anim::Path path) {
  if (path == anim::Path::rotation)
    return {trs.rotation.x, trs.rotation.y, trs.rotation.z, trs.rotation.w};
  const math::Vec3& v = path == anim::Path::translation ? trs.translation : trs.scale;
  return {v.x, v.y, v.z, 0};
}

bool differ(const Numbers& a, const Numbers& b, double noise) {
  for (std::size_t i = 0; i < 4; ++i)
    if (std::abs(a[i] - b[i]) > noise) return true;
  return false;
}

/// Of a body's translations: the size as the body's parent sees it.
double translation_noise(const Body& body, const Motion& motion, std::size_t index, double size) {
  math::Affine parent = body.between;
  if (body.base >= 0) parent = motion.worlds[static_cast<std::size_t>(body.base)][0] * parent;
  const double scale = math::length(parent.linear.x);
  const double own = std::max(math::length(body.standing.translation),
                              math::length(motion.locals[index][0].translation));
  return kNoise * std::max(scale > 0 ? size / scale : 0, own);
}

}  // namespace

std::vector<Track> find_tracks(const scene::Scene& scene, const std::vector<Body>& bodies,
                               const Motion& motion) {
  const double size = size_of(scene, bodies);
  const std::size_t frames = motion.times.size();
  std::vector<Track> tracks;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b].is_output) continue;
    math::Trs standing = bodies[b].standing;
    standing.rotation = math::normalised(standing.rotation);
    for (const anim::Path path :
         {anim::Path::translation, anim::Path::rotation, anim::Path::scale}) {
      const double noise = path == anim::Path::translation
                               ? translation_noise(bodies[b], motion, b, size)
                           : path == anim::Path::rotation ? kRotationNoise
                                                          : kNoise;
      const Numbers at_rest = numbers_of(standing, path);
      const Numbers first = numbers_of(motion.locals[b][0], path);
      bool moves = false, differs = differ(first, at_rest, noise);
      for (std::size_t f = 1; f < frames && !moves; ++f)
        moves = differ(numbers_of(motion.locals[b][f], path), first, noise);
      if (!moves && !differs) continue;
      Track track{b, path, path == anim::Path::rotation ? 4 : 3, {}, {}, !moves};
      for (std::size_t f = 0; f < (moves ? frames : 1); ++f) {
        const Numbers n = numbers_of(motion.locals[b][f], path);
        for (std::size_t i = 0; i < static_cast<std::size_t>(track.width); ++i)
          track.values.push_back(static_cast<float>(n[i]) + 0.0f);  // no negative zeros
      }
      tracks.push_back(std::move(track));
    }
  }
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
