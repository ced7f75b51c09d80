// SPDX-License-Identifier: MIT
// The sole of a foot at rest: where it touches the ground, and what it rolls on.
// Test: tests/modules/foot_roll_test.cpp
#pragma once

#include "modules/steps.h"

namespace rigc::modules {

/// Nothing of a foot is in the ground up to this tilt over an edge of its sole, in degrees. A point
/// that reaches out beyond the edge only higher up needs the edge to lie further out the more the
/// foot tilts.
inline constexpr double kEdgeTilt = 60;

/// Joints that say where a foot is; all but the ankle may be missing (invalid).
struct FootJoints {
  NodeId ankle, ball, tip, heel;
};

struct Sole {
  /// Where the measures are from, best first: vertices that foot and toes move, joints of the foot,
  /// the ankle's height alone.
  enum class From : std::uint8_t { vertices, guides, ankle };
  From from = From::ankle;
  /// Rig space: z where the foot points, y up from the ground, x = y cross z; the origin lies on
  /// the ground below the ball.
  math::Affine frame;
  double heel = 0, tip = 0;  ///< where it begins and ends along z; heel < 0 < tip
  double low = 0, high = 0;  ///< where it begins and ends along x
  double ball = 0;           ///< height at which the toes bend; 0 where they do not
  /// While the foot rises over its toes its hinge slides forward from the ball so far per degree,
  /// until it is at z = hinge: both 0 where no part of the foot lies before its ball.
  double hinge_slide = 0, hinge = 0;
  double outward = 1;  ///< sign of x on the side of the foot that looks away from the body
  /// The oval |x / a|^p + |z / c|^p = 1 about the middle, half as broad and long as the sole, holds
  /// its outline; this is p / (p - 1): 2 an ellipse, 1 a rectangle.
  double power = 2;
  /// Tilted by more than `kEdgeTilt` degrees the foot lifts by this times the sine of what is more:
  /// then it stands on what lies above the edge.
  double lift = 0;
  double length() const { return tip - heel; }
  math::Vec3 middle() const { return {(low + high) / 2, 0, (heel + tip) / 2}; }
};

/// From the parameters `toes`, a control that the ball is the joint of, `tip` and `heel`.
FootJoints foot_joints(const Builder& b, NodeId ankle);

Sole measure_sole(const Builder& b, const FootJoints& joints);

/// Says on a control, as the attribute `sole_from` that nobody keys, where the measures are from;
/// warns where they are guessed.
void report_sole(Builder& b, NodeId control, const Sole& sole);

}  // namespace rigc::modules
