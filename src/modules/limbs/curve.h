// SPDX-License-Identifier: MIT
// What modules with a curve share: a spline through controls with places along it, transforms that
// stand on something, and places between others.
// Test: tests/modules/spine_ik_test.cpp
#pragma once

#include <string>
#include <vector>

#include "modules/steps.h"

namespace rigc::modules {

struct CurveSpec {
  NodeId joint;                      ///< that the solver belongs to
  std::vector<NodeId> controls;      ///< what the curve passes through, two or more
  std::vector<double> follows;       ///< how much its direction turns with each of them
  std::vector<math::Affine> places;  ///< at rest, rig space: frames along it, from first to last
  std::vector<double> parameters;    ///< of the places, rising; empty: of the nearest point
  NodeId base;                       ///< in whose scale lengths are measured
  bool aims = false;                 ///< x of a place points at the next one, else along the curve
};

struct Curve {
  NodeId node;                  ///< spline
  std::vector<Target> outputs;  ///< the places
  Plug stretch;                 ///< number: length relative to rest
};

Curve make_curve(Builder& b, const CurveSpec& spec);

/// A point of the way through points, by its part 0..1 of the whole length.
math::Vec3 point_along(const std::vector<math::Vec3>& points, double part);
/// Of some joints the one nearest to a point.
NodeId nearest_joint(const Builder& b, const std::vector<NodeId>& joints, math::Vec3 point);
std::vector<math::Vec3> positions(const Builder& b, const std::vector<NodeId>& joints);

/// What controls of `joint` hang under as children: the space itself, or a transform that stands
/// for it where it is a joint or nothing.
NodeId stand_on(Builder& b, NodeId space, NodeId joint);

/// Lets a transform get its translate and rotation from a constraint on weighted targets, keeping
/// its offsets at rest. Gives the constraint.
NodeId ride(Builder& b, NodeId transform, const std::vector<Target>& targets,
            const std::vector<double>& weights, const std::string& role = "space");

/// Scales a joint, at rest as it is, by factors.
void scale_joint(Builder& b, NodeId joint, const Plug& factors);

}  // namespace rigc::modules
