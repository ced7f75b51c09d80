// SPDX-License-Identifier: MIT
// The geometry of chain IK: points with fixed distances that shall reach a goal. FABRIK, and a last
// closed-form step: what the iterations left open is closed by bending the chain at its most bent
// joint, so that a goal in reach is reached exactly. Test: tests/eval/chain_test.cpp
#pragma once

#include "eval/kernels/lanes.h"

namespace rigc::eval {
namespace {
namespace chain {

// Relative to the length of the chain: straighter than this counts as straight.
constexpr double kStraight = 1e-13;
constexpr double kBent = 1e-6;
// How far a straight chain is bowed before the iterations, which cannot leave a line by themselves.
constexpr double kBow = 0.1;
constexpr int kClosings = 4;

// A function: a constant would be made by this instruction set when the program starts.
RIGC_INLINE Vec3 x_axis() { return {Real(1.0), Real(0.0), Real(0.0)}; }

struct Points {
  int count = 0;
  Vec3 at[kMaxChainJoints];
  Real lengths[kMaxChainJoints];  ///< lengths[i]: from at[i] to at[i + 1]
};

RIGC_INLINE Real total_length(const Points& p) {
  Real sum{};
  for (int i = 0; i + 1 < p.count; ++i) sum = sum + p.lengths[i];
  return sum;
}

/// `v` at unit length, or where it is shorter than rounding noise of the chain its first bone's
/// direction.
RIGC_INLINE Vec3 direction(const Points& p, Vec3 v) {
  Vec3 found = x_axis();
  for (int i = p.count - 2; i >= 0; --i) found = generic::normalised(p.at[i + 1] - p.at[i], found);
  return select(generic::length(v) > kBent * total_length(p), generic::normalised(v, x_axis()),
                found);
}

/// The unit part of `v` at right angles to `axis`; zero where there is none.
RIGC_INLINE Vec3 across(Vec3 v, Vec3 axis) {
  axis = generic::unit(axis);
  const Vec3 rest = v - axis * dot(v, axis);
  const auto none = generic::length(rest) <= kBent * generic::length(v);
  return select(none, Vec3{}, generic::unit(rest));
}

/// Where the joints between bend out to, seen from unit vector `along`: unit, or zero for a
/// straight chain.
RIGC_INLINE Vec3 bend_of(const Points& p, Vec3 along) {
  Vec3 sum;
  for (int i = 1; i + 1 < p.count; ++i) {
    const Vec3 v = p.at[i] - p.at[0];
    sum = sum + (v - along * dot(v, along));
  }
  const auto straight = generic::length(sum) <= kBent * total_length(p);
  return select(straight, Vec3{}, generic::normalised(sum, x_axis()));
}

/// Puts `moved` at its distance from `fixed`, in the direction in which it lies.
RIGC_INLINE Vec3 pulled(Vec3 fixed, Vec3 moved, Real distance, Vec3 fallback) {
  return fixed + generic::normalised(moved - fixed, fallback) * distance;
}

RIGC_INLINE void iterate(Points& p, Vec3 goal, Vec3 along) {
  const Vec3 root = p.at[0];
  p.at[p.count - 1] = goal;
  for (int i = p.count - 2; i >= 0; --i)
    p.at[i] = pulled(p.at[i + 1], p.at[i], p.lengths[i], -along);
  p.at[0] = root;
  for (int i = 0; i + 1 < p.count; ++i)
    p.at[i + 1] = pulled(p.at[i], p.at[i + 1], p.lengths[i], along);
}

/// The joint that lies farthest beside the way from root to end, and where it is.
struct MostBent {
  Real index;
  Vec3 at;
};

RIGC_INLINE MostBent most_bent(const Points& p) {
  MostBent best{Real(1.0), p.at[1]};
  Real most = Real(-1.0);
  for (int i = 1; i + 1 < p.count; ++i) {
    const Real bent = generic::length(cross(p.at[i] - p.at[0], p.at[p.count - 1] - p.at[i]));
    const auto more = bent > most;
    most = select(more, bent, most);
    best.index = select(more, Real(static_cast<double>(i)), best.index);
    best.at = select(more, p.at[i], best.at);
  }
  return best;
}

/// Turns both halves of the chain about its most bent joint and the root like two rigid bones.
RIGC_INLINE void close(Points& p, Vec3 goal) {
  const Vec3 root = p.at[0], end = p.at[p.count - 1];
  const MostBent bent = most_bent(p);
  const Vec3 joint = bent.at;
  const Real a = generic::length(joint - root), b = generic::length(end - joint);
  const Real c = generic::length(goal - root);
  const auto some = (a > 0.0) & (b > 0.0) & (c > 0.0);
  const Vec3 along = generic::normalised(goal - root, x_axis());
  const Vec3 side = across(joint - root, along);
  const Real apart = select(some, c, Real(1.0));
  const Real foot = generic::clamped(((a - b) * ((a + b) / apart) + apart) * 0.5, -a, a);
  const auto straight = generic::is_zero(side);
  const Real height = select(straight, Real(0.0), generic::sqrt((a - foot) * (a + foot)));
  const Vec3 new_joint = root + generic::normalised(along * foot + side * height, along) * a;
  const Vec3 new_end = new_joint + generic::normalised(goal - new_joint, along) * b;
  const Quat first = generic::between(generic::normalised(joint - root, x_axis()),
                                      generic::normalised(new_joint - root, x_axis()));
  const Quat second = generic::between(generic::normalised(end - joint, x_axis()),
                                       generic::normalised(new_end - new_joint, x_axis()));
  for (int i = 1; i < p.count; ++i) {
    const Real at(static_cast<double>(i));
    const Vec3 before = root + rotate(first, p.at[i] - root);
    const Vec3 after = new_joint + rotate(second, p.at[i] - joint);
    const Vec3 moved = select(at < bent.index, before, select(at > bent.index, after, new_joint));
    p.at[i] = select(some, moved, p.at[i]);
  }
}

RIGC_INLINE Mask is_straight(const Points& p, Vec3 along, Real total) {
  Real most{};
  for (int i = 1; i < p.count; ++i) {
    const Vec3 v = p.at[i] - p.at[0];
    const Real beside = generic::length(v - along * dot(v, along));
    most = select(beside > most, beside, most);
  }
  return most <= kBent * total;
}

RIGC_INLINE void bow(Points& p, Mask which, Vec3 along, Vec3 bend, Real total) {
  const Vec3 side = select(generic::is_zero(bend), generic::perpendicular(along), bend);
  Real passed{};
  for (int i = 1; i + 1 < p.count; ++i) {
    passed = passed + p.lengths[i - 1];
    const Real s = passed / total;
    const Vec3 bowed = p.at[i] + side * (kBow * total * 4.0 * s * (1.0 - s));
    p.at[i] = select(which, bowed, p.at[i]);
  }
}

/// Moves all points but the first so that the last is at the goal; exactly straight where it is out
/// of reach. A straight chain that must bend bends toward `bend`, or where that is zero to any
/// side.
RIGC_INLINE void reach(Points& p, Vec3 goal, Vec3 bend, int iterations) {
  const Real total = total_length(p);
  const Vec3 root = p.at[0];
  const Vec3 to_goal = generic::normalised(goal - root, p.at[p.count - 1] - root);
  const Vec3 along = direction(p, to_goal * total);
  const auto out = generic::length(goal - root) >= total * (1.0 - kStraight);
  const auto in_reach = !out;
  if (any(in_reach)) {
    const Mask straight = is_straight(p, along, total);
    if (any(straight)) bow(p, straight, along, bend, total);
    for (int i = 0; i < iterations; ++i) iterate(p, goal, along);
    for (int i = 0; i < kClosings && p.count > 2; ++i) close(p, goal);
  }
  Vec3 stretched = root;
  for (int i = 0; i + 1 < p.count; ++i) {
    stretched = stretched + along * p.lengths[i];
    p.at[i + 1] = select(out, stretched, p.at[i + 1]);
  }
}

}  // namespace chain
}  // namespace
}  // namespace rigc::eval
