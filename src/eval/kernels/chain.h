// SPDX-License-Identifier: MIT
// IK of a chain: FABRIK (Aristidou and Lasenby 2011) in the base's space, from the rest pose each
// frame, a fixed number of iterations. The rest pose is first turned as a whole so that its end
// points at the goal, bends toward the pole and has the twist; lengths never change.
// Test: tests/eval/chain_test.cpp
#pragma once

#include "eval/kernels/chain_steps.h"

namespace rigc::eval {
namespace {

/// base, goal, pole, twist, translates...; data: count, has_pole, iterations, goal offset, rests
/// -> rotations
struct Chain {
  enum Argument : std::size_t { kBase, kGoal, kPole, kTwist, kTranslates };
  enum Table : std::size_t { kCount, kHasPole, kIterations, kGoalOffset, kRests = 6 };

  RIGC_INLINE static void run(const Lanes& lanes) {
    const double* d = lanes.data();
    const chain::Points rest = rest_points(lanes);
    const Affine to_base = into(lanes.affine(kBase));
    const Vec3 goal = to_base * (lanes.affine(kGoal) * vec3_at(d + kGoalOffset));
    const Vec3 pole = to_base * lanes.origin(kPole);
    const bool has_pole = d[kHasPole] != 0;
    const Real twist = generic::radians(lanes.number(kTwist));
    const Quat turn = whole_turn(rest, goal, has_pole, pole, twist);

    chain::Points p = rest;
    for (int i = 1; i < p.count; ++i) p.at[i] = p.at[0] + rotate(turn, rest.at[i] - rest.at[0]);
    // To one side of the rest, which turns with it: so it does not jump as the goal moves.
    const Vec3 rest_along = chain::direction(rest, rest.at[rest.count - 1] - rest.at[0]);
    Vec3 side = rotate(turn, generic::perpendicular(rest_along));
    if (has_pole) {
      const Vec3 along = generic::normalised(goal - p.at[0], chain::x_axis());
      const Vec3 toward_pole =
          rotate(generic::axis_angle(along, twist), chain::across(pole - p.at[0], goal - p.at[0]));
      side = select(generic::is_zero(toward_pole), side, toward_pole);
    }
    chain::reach(p, goal, side, static_cast<int>(d[kIterations]));
    put_rotations(lanes, p, turn);
  }

 private:
  RIGC_INLINE static Quat rest_of(const Lanes& lanes, int joint) {
    return quat_at(lanes.data() + kRests + 4 * joint);
  }

  RIGC_INLINE static Vec3 translate_of(const Lanes& lanes, int joint) {
    return lanes.vec3(kTranslates + static_cast<std::size_t>(joint));
  }

  RIGC_INLINE static chain::Points rest_points(const Lanes& lanes) {
    chain::Points p;
    p.count = static_cast<int>(lanes.data()[kCount]);
    Quat turned;
    Vec3 at;
    for (int i = 0; i < p.count; ++i) {
      const Vec3 translate = translate_of(lanes, i);
      at = at + rotate(turned, translate);
      p.at[i] = at;
      if (i > 0) p.lengths[i - 1] = generic::length(translate);
      turned = generic::normalised(turned * rest_of(lanes, i));
    }
    return p;
  }

  /// The turn of the whole rest pose about its root.
  RIGC_INLINE static Quat whole_turn(const chain::Points& rest, Vec3 goal, bool has_pole, Vec3 pole,
                                     Real twist) {
    const Vec3 root = rest.at[0];
    const Vec3 along = chain::direction(rest, rest.at[rest.count - 1] - root);
    const Vec3 to_goal = generic::normalised(goal - root, along);
    Quat turn = generic::between(along, to_goal);
    if (has_pole) {
      const Vec3 bend = rotate(turn, chain::bend_of(rest, along));
      const Vec3 wanted = chain::across(pole - root, to_goal);
      const auto lost = generic::is_zero(bend) | generic::is_zero(wanted);
      const Real angle = generic::atan2(dot(cross(bend, wanted), to_goal), dot(bend, wanted));
      turn = select(lost, turn, generic::axis_angle(to_goal, angle) * turn);
    }
    return generic::normalised(generic::axis_angle(to_goal, twist) * turn);
  }

  RIGC_INLINE static void put_rotations(const Lanes& lanes, const chain::Points& p,
                                        const Quat& turn) {
    Quat above;
    for (int i = 0; i + 1 < p.count; ++i) {
      Quat turned = generic::normalised(above * rest_of(lanes, i));
      if (i == 0) turned = generic::normalised(turn * turned);
      const Vec3 now = generic::unit(rotate(turned, translate_of(lanes, i + 1)));
      const Vec3 wanted = generic::unit(p.at[i + 1] - p.at[i]);
      const auto lost = generic::is_zero(now) | generic::is_zero(wanted);
      const Quat aimed = generic::normalised(generic::between(now, wanted) * turned);
      turned = select(lost, turned, aimed);
      lanes.put(4 * static_cast<std::size_t>(i), generic::normalised(conjugate(above) * turned));
      above = turned;
    }
  }
};

}  // namespace
}  // namespace rigc::eval
