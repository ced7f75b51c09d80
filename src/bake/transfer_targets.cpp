// SPDX-License-Identifier: MIT
// What a clip on joints plays in its file. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_targets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bake/joints.h"
#include "scene/hierarchy.h"

namespace rigc::bake {
namespace {

using scene::Kind;
using scene::NodeId;

/// Rounding to 32-bit floats, of a translation in sizes of the character.
constexpr double kNoise = 1e-7;

using Curves = std::map<std::pair<int, anim::Path>, const anim::Curve*>;

Curves curves_of(const anim::Clip& clip) {
  Curves curves;
  for (const anim::Channel& channel : clip.channels) {
    const int width = channel.path == anim::Path::rotation ? 4 : 3;
    const bool has_keys = channel.curve.times && !channel.curve.times->empty();
    if (channel.node < 0 || channel.baked || !has_keys || channel.curve.width != width) continue;
    curves.emplace(std::pair(channel.node, channel.path), &channel.curve);
  }
  return curves;
}

class Finder {
 public:
  Finder(const scene::Scene& scene, const std::vector<int>& nodes, const anim::Clip& clip,
         const std::vector<Standing>& standings)
      : scene_(scene), nodes_(nodes), standings_(standings), curves_(curves_of(clip)) {
    places_.assign(scene.size(), -1);
  }

  std::vector<Aim> find() {
    for (const NodeId id : scene_.nodes())
      if (is_target(id)) add_with_bases(id);
    return std::move(aims_);
  }

 private:
  Standing standing(NodeId id) const {
    if (!standings_.empty()) return standings_[id.index];
    return {scene::transform_above(scene_, id), {}, scene_.local(id)};
  }

  /// What hangs under a control in the file goes where that goes.
  bool is_target(NodeId id) const {
    for (NodeId at = id; at.valid(); at = standing(at).base)
      if (!scene::is_bone(scene_, at) || nodes_[at.index] < 0) return false;
    return true;
  }

  void add_with_bases(NodeId id) {
    std::vector<NodeId> path;
    for (NodeId at = id; at.valid() && places_[at.index] < 0; at = standing(at).base)
      path.push_back(at);
    for (auto at = path.rbegin(); at != path.rend(); ++at) add(*at);
  }

  void add(NodeId id) {
    Aim aim{id, -1, true, standing(id)};
    if (aim.standing.base.valid()) aim.base = places_[aim.standing.base.index];
    aim.direct = aim.standing.base == scene::transform_above(scene_, id) &&
                 aim.standing.between == math::Affine{};
    aim.translation = curve(id, anim::Path::translation);
    aim.rotation = curve(id, anim::Path::rotation);
    aim.scale = curve(id, anim::Path::scale);
    places_[id.index] = static_cast<int>(aims_.size());
    aims_.push_back(std::move(aim));
  }

  const anim::Curve* curve(NodeId id, anim::Path path) const {
    const auto found = curves_.find({nodes_[id.index], path});
    return found == curves_.end() ? nullptr : found->second;
  }

  const scene::Scene& scene_;
  const std::vector<int>& nodes_;
  const std::vector<Standing>& standings_;
  Curves curves_;
  std::vector<int> places_;  // in aims_, by scene node
  std::vector<Aim> aims_;
};

}  // namespace

math::Trs local_at(const Aim& aim, double seconds) {
  math::Trs local = aim.standing.local;
  double n[4];
  if (aim.translation) {
    anim::sample(*aim.translation, false, seconds, n);
    local.translation = {n[0], n[1], n[2]};
  }
  if (aim.rotation) {
    anim::sample(*aim.rotation, true, seconds, n);
    local.rotation = {n[0], n[1], n[2], n[3]};
  }
  if (aim.scale) {
    anim::sample(*aim.scale, false, seconds, n);
    local.scale = {n[0], n[1], n[2]};
  }
  local.rotation = math::normalised(local.rotation);
  return local;
}

const anim::Curve* curve_on(const Aim& aim, anim::Path path) {
  return path == anim::Path::translation ? aim.translation
         : path == anim::Path::rotation  ? aim.rotation
                                         : aim.scale;
}

bool is_solved(const scene::Scene& scene, const Aim& aim) {
  return is_driven(scene, aim.id) || (aim.animated() && !aim.direct);
}

std::vector<Aim> find_aims(const scene::Scene& scene, const std::vector<int>& nodes,
                           const anim::Clip& clip, const std::vector<Standing>& standings) {
  return Finder(scene, nodes, clip, standings).find();
}

double largest_difference(const Aim& aim, anim::Path path, const math::Trs& local) {
  const anim::Curve* curve = curve_on(aim, path);
  if (!curve) return differ(local_at(aim, 0), local, path);
  double largest = 0;
  const auto look = [&](double time) {
    largest = std::max(largest, differ(local_at(aim, time), local, path));
  };
  for (std::size_t i = 0; i < curve->times->size(); ++i) {
    const auto time = static_cast<double>((*curve->times)[i]);
    look(time);
    if (curve->interpolation != anim::Interpolation::cubic || i == 0) continue;
    const auto before = static_cast<double>((*curve->times)[i - 1]);
    for (double part = 1; part < 8; part += 1) look(before + (time - before) * part / 8);
  }
  return largest;
}

double differ(const math::Trs& a, const math::Trs& b, anim::Path path) {
  if (path == anim::Path::rotation) {
    const math::Quat p = math::normalised(a.rotation);
    math::Quat q = math::normalised(b.rotation);
    if (math::dot(p, q) < 0) q = -q;
    return std::max(
        {std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z), std::abs(p.w - q.w)});
  }
  const bool scale = path == anim::Path::scale;
  const math::Vec3 off = scale ? a.scale - b.scale : a.translation - b.translation;
  return std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)});
}

Noise::Noise(const scene::Scene& scene, const std::vector<Aim>& aims) : scene_(scene) {
  for (const Aim& aim : aims)
    size_ = std::max(size_, math::length(scene.rest_world(aim.id).origin));
}

double Noise::of(NodeId id, anim::Path path) const {
  if (path != anim::Path::translation) return kNoise;
  const NodeId above = scene::transform_above(scene_, id);
  const double scale = above.valid() ? math::length(scene_.rest_world(above).linear.x) : 1;
  return kNoise *
         std::max(size_ / std::max(scale, 1e-30), math::length(scene_.local(id).translation));
}

std::vector<std::vector<math::Affine>> play(const std::vector<Aim>& aims,
                                            const std::vector<double>& times) {
  std::vector<std::vector<math::Affine>> worlds(aims.size());
  for (std::size_t i = 0; i < aims.size(); ++i) {
    const Aim& aim = aims[i];
    worlds[i].reserve(times.size());
    for (std::size_t f = 0; f < times.size(); ++f) {
      const math::Affine local = aim.standing.between * math::compose(local_at(aim, times[f]));
      worlds[i].push_back(aim.base < 0 ? local
                                       : worlds[static_cast<std::size_t>(aim.base)][f] * local);
    }
  }
  return worlds;
}

}  // namespace rigc::bake
