// SPDX-License-Identifier: MIT
// Curves through controls. Test: tests/modules/spine_ik_test.cpp
#include "modules/limbs/curve.h"

#include <algorithm>

#include "math/spline.h"
#include "modules/wiring.h"

namespace rigc::modules {

using math::Affine;
using math::Vec3;
namespace at = scene::spline;
namespace transform = scene::transform;

namespace {

/// Root mean square of the columns, as the kernel measures a base.
double size_of(const math::Mat3& m) {
  const Vec3 lengths{math::length(m.x), math::length(m.y), math::length(m.z)};
  return math::length(lengths) * math::sqrt(1.0 / 3);
}

}  // namespace

std::vector<Vec3> positions(const Builder& b, const std::vector<NodeId>& joints) {
  std::vector<Vec3> points;
  for (const NodeId joint : joints) points.push_back(position(b, joint));
  return points;
}

Curve make_curve(Builder& b, const CurveSpec& spec) {
  Curve curve;
  curve.node = b.make({.kind = scene::Kind::spline,
                       .role = "driver",
                       .joint = spec.joint,
                       .parent = {},
                       .suffix = "curve"});
  const Affine base = spec.base.valid() ? rest(b, spec.base) : Affine{};
  const Affine into_base = math::inverse(base);
  if (spec.base.valid()) follow_world(b, {curve.node, at::kBase}, spec.base);
  for (std::size_t i = 0; i < spec.controls.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    follow_world(b, {curve.node, at::kControls, element}, spec.controls[i]);
    b.set({curve.node, at::kRests, element}, into_base * rest(b, spec.controls[i]));
    b.set({curve.node, at::kFollows, element}, spec.follows[i]);
  }
  const math::Spline line(positions(b, spec.controls));
  const double size = size_of(base.linear);
  double before = 0;
  for (std::size_t k = 0; k < spec.places.size(); ++k) {
    const auto element = static_cast<std::int32_t>(k);
    before = std::max(
        before, spec.parameters.empty() ? line.nearest(spec.places[k].origin) : spec.parameters[k]);
    b.set({curve.node, at::kParameters, element}, before);
    const math::Mat3 axes = math::orthonormal(spec.places[k].linear);
    const Affine frame{{axes.x * size, axes.y * size, axes.z * size}, spec.places[k].origin};
    b.set({curve.node, at::kPlaces, element}, into_base * frame);
    curve.outputs.push_back({{curve.node, at::kWorlds, element}, frame});
  }
  b.set({curve.node, at::kAims}, spec.aims ? 1.0 : 0.0);
  curve.stretch = {curve.node, at::kStretch};
  return curve;
}

Vec3 point_along(const std::vector<Vec3>& points, double part) {
  double left = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    left += math::length(points[i + 1] - points[i]) * part;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double bone = math::length(points[i + 1] - points[i]);
    if (left < bone) return points[i] + (points[i + 1] - points[i]) * (left / bone);
    left -= bone;
  }
  return points.back();
}

NodeId nearest_joint(const Builder& b, const std::vector<NodeId>& joints, Vec3 point) {
  const auto away = [&](NodeId joint) { return math::length(position(b, joint) - point); };
  return *std::min_element(joints.begin(), joints.end(),
                           [&](NodeId a, NodeId c) { return away(a) < away(c); });
}

NodeId stand_on(Builder& b, NodeId space, NodeId joint) {
  if (space.valid() && b.scene()[space].kind != scene::Kind::joint) return space;
  return make_place(b, joint, "stand", space, {character_axes(b), position(b, joint)});
}

NodeId ride(Builder& b, NodeId node, const std::vector<Target>& targets,
            const std::vector<double>& weights, const std::string& role) {
  const NodeId owner = b.index().joint(b.scene()[node].identity.owner);
  const NodeId made =
      make_constraint(b, scene::Kind::parent_constraint, node, targets, weights, true, role, owner);
  b.connect({made, scene::constraint::kTranslate}, {node, transform::kTranslate});
  b.connect({made, scene::constraint::kRotation}, {node, transform::kRotation});
  return made;
}

void scale_joint(Builder& b, NodeId joint, const Plug& factors) {
  const Vec3 own = b.scene().local(joint).scale;
  Plug scale = factors;
  if (own != Vec3{1, 1, 1}) {
    scale = compute(b, b.index().joint(b.scene()[joint].identity.owner), "scale",
                    {{"factors", factors}, {"own", scene::Value(own)}},
                    "out scale = multiply(factors, own);")["scale"];
  }
  b.connect(scale, {joint, transform::kScale});
}

}  // namespace rigc::modules
