// SPDX-License-Identifier: MIT
// IK of a chain: FABRIK (Aristidou and Lasenby 2011) in the base's space, from the rest pose each
// frame, a fixed number of iterations. The rest pose is first turned as a whole so that its end
// points at the goal, bends toward the pole and has the twist; lengths never change.
// Test: tests/eval/chain_test.cpp
#include <cmath>

#include "eval/kernels/chain_steps.h"
#include "eval/kernels/space.h"
#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

using chain::Points;
using math::Quat;
using math::Vec3;

enum Argument : std::size_t { kBase, kGoal, kPole, kTwist, kTranslates };

// Rests of the joints in the chain's table of data.
enum Table : std::size_t { kCount, kHasPole, kIterations, kGoalOffset, kRests = 6 };

Quat rest_of(const Call& call, int joint) {
  const double* d = call.data + kRests + 4 * joint;
  return {d[0], d[1], d[2], d[3]};
}

Points rest_points(const Call& call, int lane) {
  Points p;
  p.count = static_cast<int>(call.data[kCount]);
  Quat turned;
  Vec3 at;
  for (int i = 0; i < p.count; ++i) {
    const Vec3 translate = read_vec3(call.in(kTranslates + static_cast<std::size_t>(i)), lane);
    at = at + math::rotate(turned, translate);
    p.at[i] = at;
    if (i > 0) p.lengths[i - 1] = math::length(translate);
    turned = math::normalised(turned * rest_of(call, i));
  }
  return p;
}

// The turn of the whole rest pose about its root.
Quat whole_turn(const Points& rest, Vec3 goal, bool has_pole, Vec3 pole, double twist_degrees) {
  const Vec3 root = rest.at[0];
  const Vec3 along = chain::direction(rest, rest.at[rest.count - 1] - root);
  const Vec3 to_goal = math::normalised(goal - root, along);
  Quat turn = math::between(along, to_goal);
  if (has_pole) {
    const Vec3 bend = math::rotate(turn, chain::bend_of(rest, along));
    const Vec3 wanted = chain::across(pole - root, to_goal);
    if (bend != Vec3{} && wanted != Vec3{}) {
      const double angle =
          math::atan2(math::dot(math::cross(bend, wanted), to_goal), math::dot(bend, wanted));
      turn = math::axis_angle(to_goal, angle) * turn;
    }
  }
  return math::normalised(math::axis_angle(to_goal, math::radians(twist_degrees)) * turn);
}

void solve(const Call& call, int lane) {
  const Points rest = rest_points(call, lane);
  const math::Affine to_base = into(read_affine(call.in(kBase), lane));
  const double* d = call.data;
  const Vec3 offset{d[kGoalOffset], d[kGoalOffset + 1], d[kGoalOffset + 2]};
  const Vec3 goal = to_base * (read_affine(call.in(kGoal), lane) * offset);
  const Vec3 pole = to_base * read_affine(call.in(kPole), lane).origin;
  const bool has_pole = d[kHasPole] != 0;
  const Quat turn = whole_turn(rest, goal, has_pole, pole, call.in(kTwist)[lane]);

  Points p = rest;
  for (int i = 1; i < p.count; ++i) {
    p.at[i] = p.at[0] + math::rotate(turn, rest.at[i] - rest.at[0]);
  }
  Vec3 bend = has_pole ? math::rotate(math::axis_angle(math::normalised(goal - p.at[0]),
                                                       math::radians(call.in(kTwist)[lane])),
                                      chain::across(pole - p.at[0], goal - p.at[0]))
                       : Vec3{};
  // To one side of the rest, which turns with it: so it does not jump as the goal moves.
  const Vec3 along = chain::direction(rest, rest.at[rest.count - 1] - rest.at[0]);
  if (bend == Vec3{}) bend = math::rotate(turn, math::perpendicular(along));
  chain::reach(p, goal, bend, static_cast<int>(d[kIterations]));

  Quat above;
  for (int i = 0; i + 1 < p.count; ++i) {
    Quat turned = math::normalised(above * rest_of(call, i));
    if (i == 0) turned = math::normalised(turn * turned);
    const Vec3 translate = read_vec3(call.in(kTranslates + static_cast<std::size_t>(i) + 1), lane);
    const Vec3 now = math::normalised(math::rotate(turned, translate), {});
    const Vec3 wanted = math::normalised(p.at[i + 1] - p.at[i], {});
    if (now != Vec3{} && wanted != Vec3{}) {
      turned = math::normalised(math::between(now, wanted) * turned);
    }
    write(call.result() + 4 * i * kLanes, lane, math::normalised(math::conjugate(above) * turned));
    above = turned;
  }
}

}  // namespace

void ik_chain(const Call& call) {
  for (int lane = 0; lane < kLanes; ++lane) solve(call, lane);
}

}  // namespace rigc::eval
