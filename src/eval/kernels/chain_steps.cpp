// SPDX-License-Identifier: MIT
// FABRIK, and two last steps. First all bends of the chain are scaled alike until its end is as far
// away as the goal: that is smooth, also through full extension, where the iterations converge
// slowly. What is left, in chains that are folded up, is closed by bending the most bent joint.
// Test: tests/eval/chain_test.cpp
#include "eval/kernels/chain_steps.h"

#include <cmath>

namespace rigc::eval::chain {

namespace {

using math::Vec3;

// Relative to the length of the chain: straighter than this counts as straight.
constexpr double kStraight = 1e-13;
constexpr double kBent = 1e-6;
// How far a straight chain is bowed before the iterations, which cannot leave a line by themselves.
constexpr double kBow = 0.1;
constexpr int kClosings = 4;
// Steps of Newton's method for the scale of the bends, and how large its square may become.
constexpr int kSteps = 12;
constexpr double kMostBend = 16;

double total_length(const Points& p) {
  double sum = 0;
  for (int i = 0; i + 1 < p.count; ++i) sum += p.lengths[i];
  return sum;
}

void stretch_along(Points& p, Vec3 direction) {
  for (int i = 0; i + 1 < p.count; ++i) p.at[i + 1] = p.at[i] + direction * p.lengths[i];
}

// Puts `moved` at its distance from `fixed`, in the direction in which it lies.
Vec3 pulled(Vec3 fixed, Vec3 moved, double distance, Vec3 fallback) {
  return fixed + math::normalised(moved - fixed, fallback) * distance;
}

void backward(Points& p, Vec3 goal, Vec3 fallback) {
  p.at[p.count - 1] = goal;
  for (int i = p.count - 2; i >= 0; --i) {
    p.at[i] = pulled(p.at[i + 1], p.at[i], p.lengths[i], -fallback);
  }
}

void forward(Points& p, Vec3 root, Vec3 fallback) {
  p.at[0] = root;
  for (int i = 0; i + 1 < p.count; ++i) {
    p.at[i + 1] = pulled(p.at[i], p.at[i + 1], p.lengths[i], fallback);
  }
}

// A bone seen from the line from root to end: its part along it, and beside it. With the tangent of
// half its angle to the line scaled by s it is line * (q^2 - s^2 b^2) + beside * 2 s q, divided by
// q^2 + s^2 b^2, where q = 1 + along and b = |beside|.
struct Lean {
  Vec3 beside;
  double q = 2, bb = 0;
};

// The end of the chain from its root, and its derivative by the square of the scale.
struct End {
  Vec3 at, rate;
};

Vec3 leaning(const Lean& bone, Vec3 line, double scale) {
  const double qq = bone.q * bone.q, sbb = scale * scale * bone.bb;
  if (!(qq + sbb > 0)) return -line;
  return (line * (qq - sbb) + bone.beside * (2 * scale * bone.q)) * (1 / (qq + sbb));
}

Vec3 rate_of(const Lean& bone, Vec3 line, double scale) {
  const double qq = bone.q * bone.q, sbb = scale * scale * bone.bb;
  if (!(qq + sbb > 0)) return {};
  const double per = 1 / ((qq + sbb) * (qq + sbb));
  return line * (-2 * qq * bone.bb * per) + bone.beside * (bone.q * (qq - sbb) / scale * per);
}

// Scales the bends of all joints until the end is as far from the root as the goal is, and turns
// the chain to the goal. By Newton's method in the square of the scale, in which a nearly straight
// chain is linear.
void stretch(Points& p, Vec3 goal, Vec3 along, double total) {
  const Vec3 root = p.at[0];
  const double wanted = math::length(goal - root);
  const double reached = math::length(p.at[p.count - 1] - root);
  const Vec3 line = math::normalised(p.at[p.count - 1] - root, along);
  std::array<Lean, kMaxJoints> bones;
  for (int i = 0; i + 1 < p.count; ++i) {
    const Vec3 bone = math::normalised(p.at[i + 1] - p.at[i], line);
    const double x = math::dot(bone, line);
    const Vec3 beside = bone - line * x;
    bones[i] = {beside, 1 + x, math::dot(beside, beside)};
  }
  // Exact where all angles are small.
  const double given = total - reached;
  double squared = given > 1e-15 * total ? (total - wanted) / given : 1;
  squared = squared > kMostBend ? kMostBend : squared;
  for (int k = 0; k < kSteps; ++k) {
    const double scale = math::sqrt(squared);
    End end;
    for (int i = 0; i + 1 < p.count; ++i) {
      end.at = end.at + leaning(bones[i], line, scale) * p.lengths[i];
      end.rate = end.rate + rate_of(bones[i], line, scale) * p.lengths[i];
    }
    const double miss = math::dot(end.at, end.at) - wanted * wanted;
    const double rate = 2 * math::dot(end.at, end.rate);
    const double least = squared * 0x1p-10;
    const double next = rate < 0 ? squared - miss / rate : squared;
    squared = next < least ? least : next > kMostBend ? kMostBend : next;
  }
  const double scale = math::sqrt(squared);
  for (int i = 0; i + 1 < p.count; ++i)
    p.at[i + 1] = p.at[i] + leaning(bones[i], line, scale) * p.lengths[i];
  const Vec3 now = math::normalised(p.at[p.count - 1] - root, along);
  const math::Quat turn = math::between(now, math::normalised(goal - root, now));
  for (int i = 1; i < p.count; ++i) p.at[i] = root + math::rotate(turn, p.at[i] - root);
}

int most_bent(const Points& p) {
  int best = 1;
  double most = -1;
  for (int i = 1; i + 1 < p.count; ++i) {
    const double bent = math::length(math::cross(p.at[i] - p.at[0], p.at[p.count - 1] - p.at[i]));
    if (bent > most) {
      most = bent;
      best = i;
    }
  }
  return best;
}

// Turns both halves of the chain about joint `k` and the root like two rigid bones.
void close(Points& p, Vec3 goal, int k) {
  const Vec3 root = p.at[0], joint = p.at[k], end = p.at[p.count - 1];
  const double a = math::length(joint - root), b = math::length(end - joint);
  const double c = math::length(goal - root);
  if (!(a > 0 && b > 0 && c > 0)) return;
  const Vec3 along = math::normalised(goal - root);
  const Vec3 side = across(joint - root, along);
  double foot = ((a - b) * ((a + b) / c) + c) / 2;
  foot = foot > a ? a : foot < -a ? -a : foot;
  const double height = side == Vec3{} ? 0 : math::sqrt((a - foot) * (a + foot));
  const Vec3 new_joint = root + math::normalised(along * foot + side * height, along) * a;
  const Vec3 new_end = new_joint + math::normalised(goal - new_joint, along) * b;
  const math::Quat first =
      math::between(math::normalised(joint - root), math::normalised(new_joint - root));
  const math::Quat second =
      math::between(math::normalised(end - joint), math::normalised(new_end - new_joint));
  for (int i = 1; i < k; ++i) p.at[i] = root + math::rotate(first, p.at[i] - root);
  for (int i = k + 1; i < p.count; ++i) p.at[i] = new_joint + math::rotate(second, p.at[i] - joint);
  p.at[k] = new_joint;
}

void bow(Points& p, Vec3 bend, double total) {
  double passed = 0;
  for (int i = 1; i + 1 < p.count; ++i) {
    passed += p.lengths[i - 1];
    const double s = passed / total;
    p.at[i] = p.at[i] + bend * (kBow * total * 4 * s * (1 - s));
  }
}

bool is_straight(const Points& p, Vec3 along, double total) {
  for (int i = 1; i < p.count; ++i) {
    const Vec3 v = p.at[i] - p.at[0];
    if (math::length(v - along * math::dot(v, along)) > kBent * total) return false;
  }
  return true;
}

}  // namespace

Vec3 direction(const Points& points, Vec3 v) {
  if (math::length(v) > kBent * total_length(points)) return math::normalised(v);
  for (int i = 0; i + 1 < points.count; ++i) {
    const Vec3 bone = math::normalised(points.at[i + 1] - points.at[i], {});
    if (bone != Vec3{}) return bone;
  }
  return {1, 0, 0};
}

Vec3 across(Vec3 v, Vec3 axis) {
  axis = math::normalised(axis, {});
  const Vec3 rest = v - axis * math::dot(v, axis);
  return math::length(rest) <= kBent * math::length(v) ? Vec3{} : math::normalised(rest, {});
}

Vec3 bend_of(const Points& points, Vec3 along) {
  Vec3 sum;
  for (int i = 1; i + 1 < points.count; ++i) {
    const Vec3 v = points.at[i] - points.at[0];
    sum = sum + (v - along * math::dot(v, along));
  }
  return math::length(sum) <= kBent * total_length(points) ? Vec3{} : math::normalised(sum);
}

void reach(Points& p, Vec3 goal, Vec3 bend, int iterations) {
  const double total = total_length(p);
  const Vec3 root = p.at[0];
  const Vec3 along = direction(p, math::normalised(goal - root, p.at[p.count - 1] - root) * total);
  if (math::length(goal - root) >= total * (1 - kStraight)) return stretch_along(p, along);
  if (is_straight(p, along, total)) bow(p, bend, total);
  for (int i = 0; i < iterations; ++i) {
    backward(p, goal, along);
    forward(p, root, along);
  }
  if (p.count > 2) stretch(p, goal, along, total);
  for (int i = 0; i < kClosings && p.count > 2; ++i) close(p, goal, most_bent(p));
}

}  // namespace rigc::eval::chain
