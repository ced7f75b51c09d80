// SPDX-License-Identifier: MIT
// What a bake must follow. Test: tests/bake/bodies_test.cpp
#include "bake/bodies.h"

#include <algorithm>
#include <cmath>

#include "bake/joints.h"
#include "scene/hierarchy.h"

namespace rigc::bake {
namespace {

using scene::NodeId;
namespace transform = scene::transform;

// Standings were read from 32-bit floats.
constexpr double kRounding = 1e-6;

bool near(double a, double b, double size) { return std::abs(a - b) <= kRounding * size; }

bool near(const math::Vec3& a, const math::Vec3& b) {
  const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z), 1e-3});
  return near(a.x, b.x, size) && near(a.y, b.y, size) && near(a.z, b.z, size);
}

bool near(const math::Trs& a, const math::Trs& b) {
  const double turned =
      1 - std::abs(math::dot(math::normalised(a.rotation), math::normalised(b.rotation)));
  return near(a.translation, b.translation) && near(a.scale, b.scale) &&
         turned < kRounding * kRounding;
}

class Finder {
 public:
  Finder(const scene::Scene& scene, const std::vector<int>& nodes,
         const std::vector<bool>& animated, const Options& options)
      : scene_(scene), nodes_(nodes), animated_(animated), options_(options) {
    places_.assign(scene.size(), -1);
    limited_.assign(scene.size(), false);
    for (const NodeId id : scene.nodes()) {
      if (scene[id].kind != scene::Kind::limits) continue;
      if (const auto limited = scene.source({id, scene::limits::kNode}))
        limited_[limited->node.index] = true;
    }
  }

  std::vector<Body> find() {
    for (const NodeId id : scene_.nodes())
      if (scene::is_bone(scene_, id) && nodes_[id.index] >= 0 && gets_channels(id))
        add_with_bases(id);
    return std::move(bodies_);
  }

 private:
  Standing standing(NodeId id) const {
    if (!options_.standings.empty()) return options_.standings[id.index];
    return {scene::transform_above(scene_, id), {}, scene_.local(id)};
  }

  bool is_direct(NodeId id) const {
    const Standing place = standing(id);
    return place.base == scene::transform_above(scene_, id) && place.between == math::Affine{};
  }

  bool stands_as_scene(NodeId id) const { return near(standing(id).local, scene_.local(id)); }

  bool gets_channels(NodeId id) const {
    const NodeId base = standing(id).base;
    // What hangs under a control moves with it, connected or not. A limited joint may not play what
    // its own channels say.
    if (is_driven(scene_, id) || !is_direct(id) || (base.valid() && !scene::is_bone(scene_, base)))
      return true;
    return animated_[id.index] && (limited_[id.index] || !stands_as_scene(id));
  }

  /// Whether what the file plays for a node that gets no channels is what the scene evaluates.
  bool plays_as_scene(NodeId id) const {
    if (is_driven(scene_, id) || !is_direct(id) || !stands_as_scene(id)) return false;
    return !animated_[id.index] || scene_[id].kind == scene::Kind::joint || options_.controls_play;
  }

  void add_with_bases(NodeId id) {
    std::vector<NodeId> path;
    for (NodeId at = id; at.valid() && places_[at.index] < 0; at = standing(at).base)
      path.push_back(at);
    for (auto at = path.rbegin(); at != path.rend(); ++at) add(*at);
  }

  void add(NodeId id) {
    const Standing place = standing(id);
    Body body{id,
              place.base.valid() ? places_[place.base.index] : -1,
              place.between,
              place.local,
              Body::Source::local,
              scene::is_bone(scene_, id) && gets_channels(id)};
    const bool base_plays = body.base < 0 || bodies_[static_cast<std::size_t>(body.base)].source !=
                                                 Body::Source::standing;
    const bool follows = base_plays && is_direct(id);
    if (body.is_output)
      body.source = follows ? Body::Source::local : Body::Source::world;
    else if (!follows || !plays_as_scene(id))
      body.source = Body::Source::standing;
    places_[id.index] = static_cast<int>(bodies_.size());
    bodies_.push_back(body);
  }

  const scene::Scene& scene_;
  const std::vector<int>& nodes_;
  const std::vector<bool>& animated_;
  const Options& options_;
  std::vector<int> places_;    // in bodies_, by scene node
  std::vector<bool> limited_;  // by scene node
  std::vector<Body> bodies_;
};

}  // namespace

std::vector<Body> find_bodies(const scene::Scene& scene, const std::vector<int>& nodes,
                              const std::vector<bool>& animated, const Options& options) {
  return Finder(scene, nodes, animated, options).find();
}

namespace {

/// Of a body without any before or after it in the file: as long as its bone in the scene, or as
/// the way from the origin; of what is there, a unit.
double length_alone(const scene::Scene& scene, NodeId id) {
  const math::Vec3 origin = scene.rest_world(id).origin;
  const NodeId parent = scene[id].parent;
  const double bone = parent.valid() ? math::length(origin - scene.rest_world(parent).origin) : 0.0;
  const double way = math::length(origin);
  return bone > 0 ? bone : way > 0 ? way : 1.0;
}

/// Finds what moves with bodies without being one.
void add_points(const scene::Scene& scene, const std::vector<int>& nodes,
                const std::vector<Body>& bodies, const std::vector<Standing>& standings,
                std::vector<Reach>& out) {
  std::vector<int> places(scene.size(), -1);
  for (std::size_t i = 0; i < bodies.size(); ++i) places[bodies[i].id.index] = static_cast<int>(i);
  for (const NodeId id : scene.nodes()) {
    if (scene[id].kind != scene::Kind::joint || nodes[id.index] < 0) continue;
    math::Affine way;  // from the body to the joint
    NodeId at = id;
    for (; at.valid() && places[at.index] < 0; at = standings[at.index].base)
      way = standings[at.index].between * math::compose(standings[at.index].local) * way;
    if (!at.valid()) continue;
    Reach& reach = out[static_cast<std::size_t>(places[at.index])];
    if (at != id) reach.points.push_back(way.origin);
    for (const math::Vec3& point : standings[id.index].points) reach.points.push_back(way * point);
  }
}

/// A point of a body, rig space at rest, is felt by the body and all above it.
void feel(const math::Vec3& point, std::size_t body, const std::vector<Body>& bodies,
          const std::vector<math::Affine>& rests, std::vector<Reach>& out) {
  out[body].limb = std::max(out[body].limb, math::length(point - rests[body].origin));
  for (int above = static_cast<int>(body); above >= 0;
       above = bodies[static_cast<std::size_t>(above)].base) {
    const auto at = static_cast<std::size_t>(above);
    out[at].subtree = std::max(out[at].subtree, math::length(point - rests[at].origin));
  }
}

}  // namespace

std::vector<Reach> reaches(const scene::Scene& scene, const std::vector<int>& nodes,
                           const std::vector<Body>& bodies, const Options& options) {
  std::vector<Reach> out(bodies.size());
  std::vector<math::Affine> rests;
  for (const Body& body : bodies) rests.push_back(scene.rest_world(body.id));
  if (!options.standings.empty()) add_points(scene, nodes, bodies, options.standings, out);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (const math::Vec3& point : out[i].points) feel(rests[i] * point, i, bodies, rests, out);
    if (bodies[i].base < 0) continue;
    const auto base = static_cast<std::size_t>(bodies[i].base);
    out[i].scale = std::max(math::length(rests[base].linear.x), 1e-12);
    feel(rests[i].origin, base, bodies, rests, out);
    // Of a leaf: as long as the bone before it.
    out[i].limb = std::max(out[i].limb, math::length(rests[i].origin - rests[base].origin));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (out[i].limb == 0) out[i].limb = length_alone(scene, bodies[i].id);
    out[i].subtree = std::max(out[i].subtree, out[i].limb);
  }
  return out;
}

math::Affine world_of(const Body& body, const math::Trs& local, const math::Affine* base) {
  const math::Affine matrix = math::compose(local);
  if (body.between == math::Affine{}) return base ? *base * matrix : matrix;
  return base ? *base * body.between * matrix : body.between * matrix;
}

double distance(const math::Affine& a, const math::Affine& b, const Reach& reach) {
  double largest = math::length(a.origin - b.origin);
  for (const auto axis : {&math::Mat3::x, &math::Mat3::y, &math::Mat3::z}) {
    const double length = math::length(b.linear.*axis);
    if (length < 1e-30) continue;
    const math::Vec3 off = (a.linear.*axis - b.linear.*axis) * (reach.limb / length);
    largest = std::max(largest, math::length(a.origin - b.origin + off));
  }
  for (const math::Vec3& point : reach.points)
    largest = std::max(largest, math::length(a * point - b * point));
  return largest;
}

}  // namespace rigc::bake
