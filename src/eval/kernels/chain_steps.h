// SPDX-License-Identifier: MIT
// The geometry of chain IK: points with fixed distances that shall reach a goal. FABRIK, and two
// last steps. First all bends of the chain are scaled alike until its end is as far away as the
// goal: that is smooth, also through full extension, where the iterations converge slowly. What is
// left, in chains that are folded up, is closed by bending the most bent joint.
// Test: tests/eval/chain_test.cpp
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
// Steps of Newton's method for the scale of the bends, and how large its square may become.
constexpr int kSteps = 12;
constexpr double kMostBend = 16;

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

/// A bone seen from the line from root to end: its part along it, and beside it. With the tangent
/// of half its angle to the line scaled by s it is line * (q^2 - s^2 b^2) + beside * 2 s q, divided
/// by q^2 + s^2 b^2, where q = 1 + along and b = |beside|.
struct Lean {
  Vec3 beside;
  Real q, bb;
};

RIGC_INLINE Lean lean_of(const Points& p, int bone, Vec3 line) {
  const Vec3 along = generic::normalised(p.at[bone + 1] - p.at[bone], line);
  const Real x = dot(along, line);
  const Vec3 beside = along - line * x;
  return {beside, 1.0 + x, dot(beside, beside)};
}

RIGC_INLINE Vec3 leaning(const Lean& bone, Vec3 line, Real scale) {
  const Real qq = bone.q * bone.q, sbb = scale * scale * bone.bb;
  const auto plain = qq + sbb > 0.0;
  const Real per = 1.0 / select(plain, qq + sbb, Real(1.0));
  const Vec3 found = (line * (qq - sbb) + bone.beside * (2.0 * scale * bone.q)) * per;
  return select(plain, found, -line);
}

/// Its derivative by the square of the scale.
RIGC_INLINE Vec3 rate_of(const Lean& bone, Vec3 line, Real scale) {
  const Real qq = bone.q * bone.q, sbb = scale * scale * bone.bb;
  const auto plain = qq + sbb > 0.0;
  const Real sum = select(plain, qq + sbb, Real(1.0));
  const Real per = 1.0 / (sum * sum);
  const Vec3 found =
      line * (-2.0 * qq * bone.bb * per) + bone.beside * (bone.q * (qq - sbb) / scale * per);
  return select(plain, found, Vec3{});
}

/// The square of the scale of all bends that brings the end as far from the root as `wanted`, by
/// Newton's method: a nearly straight chain is linear in it.
RIGC_INLINE Real bend_scale(const Points& p, const Lean* bones, Vec3 line, Real squared,
                            Real wanted) {
  for (int k = 0; k < kSteps; ++k) {
    const Real scale = generic::sqrt(squared);
    Vec3 end, rate;
    for (int i = 0; i + 1 < p.count; ++i) {
      end = end + leaning(bones[i], line, scale) * p.lengths[i];
      rate = rate + rate_of(bones[i], line, scale) * p.lengths[i];
    }
    const Real miss = dot(end, end) - wanted * wanted;
    const Real slope = 2.0 * dot(end, rate);
    const auto falls = slope < 0.0;
    const Real next = select(falls, squared - miss / select(falls, slope, Real(1.0)), squared);
    const Real least = squared * 0x1p-10;
    squared = select(next < least, least, select(next > kMostBend, Real(kMostBend), next));
  }
  return squared;
}

/// Scales the bends of all joints until the end is as far from the root as the goal is, and turns
/// the chain to the goal.
RIGC_INLINE void stretch(Points& p, Vec3 goal, Vec3 along, Real total) {
  const Vec3 root = p.at[0];
  const Real wanted = generic::length(goal - root);
  const Real reached = generic::length(p.at[p.count - 1] - root);
  const Vec3 line = generic::normalised(p.at[p.count - 1] - root, along);
  Lean bones[kMaxChainJoints];
  for (int i = 0; i + 1 < p.count; ++i) bones[i] = lean_of(p, i, line);
  // Exact where all angles are small.
  const Real given = total - reached;
  const auto bent = given > 1e-15 * total;
  Real squared = select(bent, (total - wanted) / select(bent, given, Real(1.0)), Real(1.0));
  squared = select(squared > kMostBend, Real(kMostBend), squared);
  squared = bend_scale(p, bones, line, squared, wanted);
  const Real scale = generic::sqrt(squared);
  for (int i = 0; i + 1 < p.count; ++i)
    p.at[i + 1] = p.at[i] + leaning(bones[i], line, scale) * p.lengths[i];
  const Vec3 now = generic::normalised(p.at[p.count - 1] - root, along);
  const Quat turn = generic::between(now, generic::normalised(goal - root, now));
  for (int i = 1; i < p.count; ++i) p.at[i] = root + rotate(turn, p.at[i] - root);
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

RIGC_INLINE void bow(Points& p, Mask which, Vec3 bend, Real total) {
  Real passed{};
  for (int i = 1; i + 1 < p.count; ++i) {
    passed = passed + p.lengths[i - 1];
    const Real s = passed / total;
    const Vec3 bowed = p.at[i] + bend * (kBow * total * 4.0 * s * (1.0 - s));
    p.at[i] = select(which, bowed, p.at[i]);
  }
}

/// Moves all points but the first so that the last is at the goal; exactly straight where it is out
/// of reach. A straight chain that must bend bends toward unit vector `bend`.
RIGC_INLINE void reach(Points& p, Vec3 goal, Vec3 bend, int iterations) {
  const Real total = total_length(p);
  const Vec3 root = p.at[0];
  const Vec3 to_goal = generic::normalised(goal - root, p.at[p.count - 1] - root);
  const Vec3 along = direction(p, to_goal * total);
  const auto out = generic::length(goal - root) >= total * (1.0 - kStraight);
  const auto in_reach = !out;
  if (any(in_reach)) {
    const Mask straight = is_straight(p, along, total);
    if (any(straight)) bow(p, straight, bend, total);
    for (int i = 0; i < iterations; ++i) iterate(p, goal, along);
    if (p.count > 2) stretch(p, goal, along, total);
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
