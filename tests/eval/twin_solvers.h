// SPDX-License-Identifier: MIT
// The scalar twins of the solvers: what scene/kinds.h and kernels/table.h say, in angles and
// matrices of long double, one lane at a time. For input that has one answer: independent columns,
// a target off the node. Degenerate input is in twins_test.cpp, with the answer written out.
#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "tests/eval/exact.h"
#include "tests/eval/jobs.h"

namespace rigc::exact {

using test::Arguments;
using test::Numbers;

/// A rotation that is given as three angles in degrees.
struct Angles {
  M turn;
};
/// A number that is measured against itself.
struct Ratio {
  Real value;
};
/// What an operation gives, in the order of its rows: a number, a place or scale, a rotation (a
/// quaternion there), three angles, a matrix.
using Part = std::variant<Real, Ratio, V, M, Angles, A>;

struct Result {
  std::vector<Part> parts;
  /// What places and numbers are measured against: the larger of limb and distance from the origin.
  Real size = 1;
  /// How much larger the answer's error is than the input's.
  Real condition = 1;
  /// Whether the input is so near to where the answer jumps that there is none.
  bool certain = true;
};

inline const math::Affine& matrix_at(const Arguments& a, std::size_t i) {
  return std::get<math::Affine>(a[i]);
}
inline V vector_at(const Arguments& a, std::size_t i) { return std::get<math::Vec3>(a[i]); }
inline Real number_at(const Arguments& a, std::size_t i) { return std::get<double>(a[i]); }
inline math::Quat quat_at(const Numbers& d, std::size_t i) {
  return {d[i], d[i + 1], d[i + 2], d[i + 3]};
}
inline V vec3_at(const Numbers& d, std::size_t i) { return {d[i], d[i + 1], d[i + 2]}; }

/// Columns of a matrix relative to each other: how much a solution in its space grows.
inline Real condition_of(const M& m) {
  Real least = 1e300L, most = 0;
  const M r = orthonormal(m);
  const V s = scales(r, m);
  for (std::size_t i = 0; i < 3; ++i) {
    least = fminl(least, fabsl(s[i]));
    most = fmaxl(most, length(m[i]));
  }
  return most / least;
}

/// Weights below 0 count as 0; without any all are equal.
inline std::vector<Real> shares(const Arguments& a, std::size_t first, std::size_t count) {
  std::vector<Real> w;
  Real sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    w.push_back(fmaxl(0, number_at(a, first + 2 * i)));
    sum += w.back();
  }
  for (Real& each : w) each = sum > 0 ? each / sum : 1 / static_cast<Real>(count);
  return w;
}

inline Result two_bone(const Arguments& a, const Numbers& d) {
  const A base = matrix_at(a, 0);
  const V start_scale = vector_at(a, 7), middle_scale = vector_at(a, 8);
  const V upper = times_each(vector_at(a, 5), start_scale);
  const V lower = times_each(times_each(vector_at(a, 6), start_scale), middle_scale);
  const Real size = cbrtl(fabsl(determinant(base.linear)));
  const Real first = length(upper) * size, second = length(lower) * size;
  const V start = base * vector_at(a, 4);
  const V goal = A(matrix_at(a, 1)) * vec3_at(d, 0), pole = matrix_at(a, 2).origin;
  const M base_turn = orthonormal(base.linear);
  const Real distance = length(goal - start);
  const V along = unit(goal - start), aside = beside(unit(pole - start), along);
  const V rest_normal = beside(base_turn * unit(vec3_at(d, 11)), along);
  const bool has_plane = length(aside) >= 1e-6L;
  V normal = unit(has_plane ? cross(along, aside) : rest_normal);
  const bool turns_joints = std::holds_alternative<math::Vec3>(a[3]);
  const V twist = turns_joints ? vector_at(a, 3) : V{number_at(a, 3), 0, 0};
  normal = turn(along, twist.x * kDegree) * normal;
  // The law of cosines at the root; a goal out of reach is where the limb can get.
  const Real shortest_reach = fabsl(first - second), longest_reach = first + second;
  const Real reach = std::clamp(distance, shortest_reach, longest_reach);
  Real cosine = (first * first + reach * reach - second * second) / (2 * first * reach);
  if (reach == longest_reach) cosine = 1;
  if (reach == shortest_reach) cosine = first > second ? 1 : -1;
  const V bone = turn(normal, acosl(std::clamp(cosine, -1.0L, 1.0L))) * along;
  const V middle = start + bone * first;
  const V other = unit(start + along * reach - middle, along);
  // A joint: x along its bone, z the normal; then what brings the child onto the bone.
  const V scale = times_each(scales(base_turn, base.linear), start_scale);
  const V mirror{1, 1, scales(base_turn, base.linear).z < 0 ? -1.0L : 1.0L};
  Result out;
  const V bones[] = {bone, other}, children[] = {upper, lower}, starts[] = {start, middle};
  const V totals[] = {scale, times_each(scale, middle_scale)};
  for (std::size_t i = 0; i < 2; ++i) {
    const M offset = turn(quat_at(d, 3 + 4 * i));
    const V seen = offset * unit(times_each(children[i], mirror));
    const V z = turn(bones[i], twist[i + 1] * kDegree) * normal;
    const M turned = M(bones[i], cross(z, bones[i]), z) * shortest(seen, {1, 0, 0});
    out.parts.push_back(A(scaled(turned * offset, totals[i]), starts[i]));
  }
  const Real limb = first + second;
  out.size = fmaxl(limb, fmaxl(length(start), length(goal)));
  const Real height = first * sqrtl(fmaxl(0, 1 - cosine * cosine));
  out.condition = out.size / fminl(first, second) * (limb / distance) *
                  (1 / (has_plane ? length(aside) : length(rest_normal))) *
                  (reach == distance ? limb / fmaxl(height, 1e-30L) : 1) *
                  condition_of(base.linear);
  out.certain = first > 0 && second > 0 && fabsl(length(aside) - 1e-6L) > 1e-9L;
  return out;
}

/// The frame that aims, and where it is.
struct Aiming {
  A parent, world;
  Real size = 1, condition = 1;
};
inline Aiming aiming(const Arguments& a, const Numbers& d) {
  const auto count = static_cast<std::size_t>(d[0]);
  const A parent = matrix_at(a, 0), up_target = matrix_at(a, 2);
  const V position = parent * vector_at(a, 1), up = vector_at(a, 3);
  const std::vector<Real> share = shares(a, 5, count);
  V mean;
  Aiming out;
  out.size = length(position);
  for (std::size_t i = 0; i < count; ++i) {
    const V at = matrix_at(a, 4 + 2 * i).origin;
    mean = mean + at * share[i];
    out.size = fmaxl(out.size, length(at));
  }
  const V toward = unit(mean - position);
  V upward = up;
  if (d[1] == 1) upward = up_target.origin - position;
  if (d[1] == 2) upward = orthonormal(up_target.linear) * up;
  out.parent = parent;
  out.world = {frame(toward, upward), position};
  out.condition = out.size / length(mean - position) / length(beside(unit(upward), toward)) *
                  condition_of(parent.linear);
  if (d[1] == 1) out.condition *= fmaxl(out.size / length(upward), 1);
  if (d[1] == 2) out.condition *= condition_of(up_target.linear);
  return out;
}

inline Result aim(const Arguments& a, const Numbers& d) {
  const Aiming found = aiming(a, d);
  const M turned = found.world.linear * turn(quat_at(d, 2));
  Result out;
  out.parts = {orthonormal(into(found.parent).linear * turned)};
  out.size = found.size;
  out.condition = found.condition * condition_of(found.parent.linear);
  return out;
}

inline M matrix_at(const Numbers& d, std::size_t i) {
  return {vec3_at(d, i), vec3_at(d, i + 3), vec3_at(d, i + 6)};
}

inline Result aim_world(const Arguments& a, const Numbers& d) {
  const Aiming found = aiming(a, d);
  Result out;
  out.parts = {A(found.world.linear * matrix_at(d, 2), found.world.origin)};
  out.size = found.size;
  out.condition = found.condition;
  return out;
}

/// The mean rotation of what has been added so far: by the shorter way to the next, as far as its
/// share of all so far.
struct MeanTurn {
  M turned;
  Real so_far = 0;
  Real condition = 1;  ///< grows toward half turns, where the shorter way jumps
  bool certain = true;
  void add(const M& next, Real share) {
    so_far += share;
    const Turn way = axis_angle(next * transposed(turned));
    if (so_far == share) {
      turned = next;
      return;
    }
    condition = fmaxl(condition, 2 / (kPi - way.angle));
    certain = certain && way.angle < kPi - 1e-3L;
    turned = turn(way.axis, way.angle * share / so_far) * turned;
  }
};

inline Result blend(const Arguments& a, const Numbers& d) {
  const auto count = static_cast<std::size_t>(d[0]);
  const std::vector<Real> share = shares(a, 1, count);
  Result out;
  V place;
  MeanTurn mean;
  for (std::size_t i = 0; i < count; ++i) {
    if (share[i] == 0) continue;
    const A target = matrix_at(a, 2 * i);
    const V own = vec3_at(d, 10 + 12 * i), at = target * own;
    place = place + at * share[i];
    mean.add(target.linear * matrix_at(d, 1 + 12 * i), share[i]);
    out.size = fmaxl(out.size, length(target.linear.x) * length(own) + length(target.origin));
  }
  out.certain = mean.certain;
  out.condition = mean.condition;
  out.parts = {A(mean.turned, place)};
  return out;
}

inline Result constraint(const Arguments& a, const Numbers& d) {
  const auto count = static_cast<std::size_t>(d[0]);
  const A to_parent = into(matrix_at(a, 0));
  const std::vector<Real> share = shares(a, 2, count);
  Result out;
  out.size = length(to_parent.origin);
  V place, scale;
  MeanTurn mean;
  for (std::size_t i = 0; i < count; ++i) {
    if (share[i] == 0) continue;
    const A offset = math::Affine{{{d[2 + 12 * i], d[3 + 12 * i], d[4 + 12 * i]},
                                   {d[5 + 12 * i], d[6 + 12 * i], d[7 + 12 * i]},
                                   {d[8 + 12 * i], d[9 + 12 * i], d[10 + 12 * i]}},
                                  {d[11 + 12 * i], d[12 + 12 * i], d[13 + 12 * i]}};
    A local = to_parent * A(matrix_at(a, 1 + 2 * i)) * offset;
    if (d[1] == eval::constraint_table::kPoint)
      local = {M{}, to_parent * V(matrix_at(a, 1 + 2 * i).origin) + offset.origin};
    const M turned = orthonormal(local.linear);
    const V scaled = scales(turned, local.linear);
    place = place + local.origin * share[i];
    scale = scale + scaled * share[i];
    out.size = fmaxl(out.size, fmaxl(length(local.origin), length(scaled)));
    out.condition = fmaxl(out.condition, condition_of(local.linear));
    mean.add(turned, share[i]);
  }
  out.certain = mean.certain;
  out.parts = {place, mean.turned, scale};
  out.condition *= condition_of(A(matrix_at(a, 0)).linear);
  return out;
}

/// FABRIK on points, and the closing steps: kernels/chain_steps.h.
struct Points {
  std::vector<V> at;
  std::vector<Real> bones;
  Real total = 0;

  V root() const { return at[0]; }
  void iterate(V goal) {
    const V from = root();
    at.back() = goal;
    for (std::size_t i = bones.size(); i-- > 0;)
      at[i] = at[i + 1] + unit(at[i] - at[i + 1]) * bones[i];
    at[0] = from;
    for (std::size_t i = 0; i < bones.size(); ++i)
      at[i + 1] = at[i] + unit(at[i + 1] - at[i]) * bones[i];
  }
  /// Straightens all joints alike: tangents of half the bones' angles to the line from the
  /// root to the end times a factor, found by halving an interval. Only straightens.
  bool stretch(V goal) {
    const V line = unit(at.back() - root());
    const Real wanted = length(goal - root());
    std::vector<V> dirs;
    for (std::size_t i = 0; i < bones.size(); ++i) dirs.push_back(unit(at[i + 1] - at[i]));
    const auto leaning = [&](V d, Real factor) {
      const Real angle = 2 * atanl(factor * tanl(atan2l(length(cross(line, d)), dot(line, d)) / 2));
      return line * cosl(angle) + unit(beside(d, line)) * sinl(angle);
    };
    const auto end = [&](Real factor) {
      V sum;
      for (std::size_t i = 0; i < bones.size(); ++i)
        sum = sum + leaning(dirs[i], factor) * bones[i];
      return sum;
    };
    Real low = 0, high = 2;
    if (length(end(high)) > wanted) return false;
    for (int i = 0; i < 200; ++i) {
      const Real middle = (low + high) / 2;
      (length(end(middle)) > wanted ? low : high) = middle;
    }
    const M turned = shortest(unit(end(high)), unit(goal - root()));
    for (std::size_t i = 0; i < bones.size(); ++i)
      at[i + 1] = at[i] + turned * (leaning(dirs[i], high) * bones[i]);
    return true;
  }
  /// Bends at the joint that bends most, by the law of cosines; gives how clear that choice was.
  Real close(V goal) {
    std::size_t k = 1;
    Real most = -1, next = -1;
    for (std::size_t i = 1; i < bones.size(); ++i) {
      const Real bent = length(cross(at[i] - root(), at.back() - at[i]));
      if (bent > most)
        next = most, most = bent, k = i;
      else
        next = fmaxl(next, bent);
    }
    const V joint = at[k], to_joint = joint - root(), to_end = at.back() - joint;
    const Real a = length(to_joint), b = length(to_end), c = length(goal - root());
    const V along = unit(goal - root()), side = unit(beside(to_joint, along));
    const Real cosine = std::clamp((a * a + c * c - b * b) / (2 * a * c), -1.0L, 1.0L);
    const V moved = root() + (along * cosine + side * sqrtl(1 - cosine * cosine)) * a;
    const M first = shortest(unit(to_joint), unit(moved - root()));
    const M second = shortest(unit(to_end), unit(goal - moved));
    for (std::size_t i = 1; i < k; ++i) at[i] = root() + first * (at[i] - root());
    for (std::size_t i = k + 1; i < at.size(); ++i) at[i] = moved + second * (at[i] - joint);
    at[k] = moved;
    return (most - next) / (total * total);
  }
};

inline V bend_of(const Points& p, V along) {
  V sum;
  for (std::size_t i = 1; i + 1 < p.at.size(); ++i) sum = sum + beside(p.at[i] - p.root(), along);
  return sum;
}

/// For chains whose rest is not straight.
inline Result chain(const Arguments& a, const Numbers& d) {
  const auto count = static_cast<std::size_t>(d[0]);
  const A to_base = into(matrix_at(a, 0));
  std::vector<M> rests;
  Points p;
  M turned;
  V at;
  for (std::size_t i = 0; i < count; ++i) {
    const V translate = vector_at(a, 4 + i);
    at = at + turned * translate;
    p.at.push_back(at);
    if (i > 0) p.bones.push_back(length(translate)), p.total += p.bones.back();
    rests.push_back(turn(quat_at(d, 6 + 4 * i)));
    turned = turned * rests.back();
  }
  const V goal = to_base * (A(matrix_at(a, 1)) * vec3_at(d, 3));
  const V root = p.root(), to_pole = to_base * V(matrix_at(a, 2).origin) - root;
  const V along = unit(p.at.back() - root), to_goal = unit(goal - root);
  Result out;
  out.size = fmaxl(p.total, fmaxl(length(root), length(goal)));
  out.condition = out.size / p.total * condition_of(A(matrix_at(a, 0)).linear) * p.total /
                  length(p.at.back() - root) * p.total / length(goal - root);
  // The rest pose is turned as a whole: its end to the goal, its bend to the pole, twisted.
  M whole = shortest(along, to_goal);
  if (d[1] != 0) {
    const V bend = whole * bend_of(p, along), wanted = beside(to_pole, to_goal);
    whole = turn(to_goal, atan2l(dot(cross(bend, wanted), to_goal), dot(bend, wanted))) * whole;
    out.condition *= fmaxl(1, p.total / length(bend)) * length(to_pole) / length(wanted);
    out.certain = length(bend) > 1e-5L * p.total && length(wanted) > 1e-5L * length(to_pole);
  }
  whole = turn(to_goal, number_at(a, 3) * kDegree) * whole;
  for (std::size_t i = 1; i < count; ++i) p.at[i] = root + whole * (p.at[i] - root);
  if (length(goal - root) >= p.total * (1 - 1e-13L)) {
    for (std::size_t i = 0; i + 1 < count; ++i) p.at[i + 1] = p.at[i] + to_goal * p.bones[i];
  } else {
    for (int i = 0; i < static_cast<int>(d[2]); ++i) p.iterate(goal);
    if (count > 2) out.certain = p.stretch(goal) && out.certain;
    for (int i = 0; i < 4 && count > 2; ++i) out.certain = p.close(goal) > 1e-6L && out.certain;
  }
  M above;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    M now = above * rests[i];
    if (i == 0) now = whole * now;
    const V has = unit(now * vector_at(a, 5 + i)), wants = unit(p.at[i + 1] - p.at[i]);
    out.certain = out.certain && dot(has, wants) > -0.999L;
    now = shortest(has, wants) * now;
    out.parts.push_back(transposed(above) * now);
    above = now;
  }
  return out;
}

/// The table of the kernels that clamp: min, max, axes, origin, rest, order.
struct Bounds {
  V low, high;
  M axes;
  V origin;
  M rest;
  std::size_t order[3];
  explicit Bounds(const Numbers& d)
      : low(vec3_at(d, 0)),
        high(vec3_at(d, 3)),
        axes(turn(quat_at(d, 6))),
        origin(vec3_at(d, 10)),
        rest(turn(quat_at(d, 13))),
        order{static_cast<std::size_t>(d[17]), static_cast<std::size_t>(d[18]),
              static_cast<std::size_t>(d[19])} {}
};

inline Result limit_vector(const Arguments& a, const Numbers& d) {
  const Bounds bounds(d);
  V inside = transposed(bounds.axes) * (vector_at(a, 0) - bounds.origin);
  for (std::size_t i = 0; i < 3; ++i)
    inside[i] = fminl(fmaxl(inside[i], bounds.low[i]), bounds.high[i]);
  Result out;
  out.parts = {bounds.origin + bounds.axes * inside};
  out.size = fmaxl(length(bounds.origin), length(vector_at(a, 0)));
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::isfinite(d[i])) out.size = fmaxl(out.size, fabsl(bounds.low[i]));
    if (std::isfinite(d[3 + i])) out.size = fmaxl(out.size, fabsl(bounds.high[i]));
  }
  return out;
}

/// R = R(order[2]) * R(order[1]) * R(order[0]); of the two triples that with the smaller sum.
inline V angles_of(const M& m, const std::size_t* order, Result& out) {
  const std::size_t a = order[0], b = order[1], c = order[2];
  const Real s = (b + 3 - a) % 3 == 1 ? 1 : -1;
  const Real lying = hypotl(m[a][a], m[a][b]);
  V first, second;
  first[a] = atan2l(s * m[b][c], m[c][c]) / kDegree;
  first[b] = atan2l(-s * m[a][c], lying) / kDegree;
  first[c] = atan2l(s * m[a][b], m[a][a]) / kDegree;
  second[a] = first[a] > 0 ? first[a] - 180 : first[a] + 180;
  second[b] = (first[b] < 0 ? -180 : 180) - first[b];
  second[c] = first[c] > 0 ? first[c] - 180 : first[c] + 180;
  Real sums[2] = {0, 0};
  for (std::size_t i = 0; i < 3; ++i) sums[0] += fabsl(first[i]), sums[1] += fabsl(second[i]);
  out.certain = fabsl(sums[0] - sums[1]) > 1e-6L && lying > 1e-6L;
  out.condition = 1 / lying;
  return sums[1] < sums[0] ? second : first;
}

inline Result limit_rotation(const Arguments& a, const Numbers& d) {
  const Bounds bounds(d);
  const M value = turn(std::get<math::Quat>(a[0]));
  Result out;
  const M& axes = bounds.axes;
  const V angles =
      angles_of(transposed(axes) * value * transposed(bounds.rest) * axes, bounds.order, out);
  M m;
  for (const std::size_t axis : bounds.order) {
    const Real low = bounds.low[axis], high = bounds.high[axis];
    const bool bounded = std::isfinite(low) && std::isfinite(high);
    Real best = angles[axis], least = 1e300L, next = 1e300L;
    for (int turns = bounded ? -1 : 0; turns <= (bounded ? 1 : 0); ++turns) {
      const Real tried = angles[axis] + 360 * turns;
      const Real off = fmaxl(0, fmaxl(low - tried, tried - high));
      if (off < least)
        next = least, least = off, best = tried;
      else
        next = fminl(next, off);
    }
    out.certain = out.certain && (next - least > 1e-6L || least == 0);
    m = turn_degrees(axis, fminl(fmaxl(best, low), high)) * m;
  }
  out.parts = {axes * m * transposed(axes) * bounds.rest};
  return out;
}

inline Result remap(const Arguments& a, const Numbers& d) {
  const Real range = number_at(a, 2) - number_at(a, 1);
  Real x = range == 0 ? 0 : (number_at(a, 0) - number_at(a, 1)) / range;
  if (d[0] != 0) x = std::clamp(x, 0.0L, 1.0L);
  struct Point {
    Real x, y, kind, slope;
  };
  std::vector<Point> p;
  for (std::size_t i = 2; i < d.size(); i += 4) p.push_back({d[i], d[i + 1], d[i + 2], d[i + 3]});
  Real y = p.empty() ? x : p[0].y;
  const auto outside = [&](const Point& l, const Point& r, const Point& end) {
    const Real slope = l.kind == 3 ? end.slope : l.kind == 1 ? (r.y - l.y) / (r.x - l.x) : 0;
    return end.y + (d[0] != 0 ? 0 : slope * (x - end.x));
  };
  Result out;
  Real steepest = 1;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const Real h = p[i + 1].x - p[i].x, t = (x - p[i].x) / h, rise = p[i + 1].y - p[i].y;
    steepest = fmaxl(steepest, fabsl(rise / h) + fabsl(p[i].slope) + fabsl(p[i + 1].slope));
    // Where a curve steps, rounding decides.
    out.certain = out.certain && (p[i].kind != 0 || fabsl(x - p[i + 1].x) > 1e-9L);
    if (x < p[i].x || x >= p[i + 1].x) continue;
    if (p[i].kind == 0) y = p[i].y;
    if (p[i].kind == 1) y = p[i].y + rise * t;
    if (p[i].kind == 2) y = p[i].y + rise * (3 * t * t - 2 * t * t * t);
    if (p[i].kind == 3)  // Hermite's basis
      y = (2 * t * t * t - 3 * t * t + 1) * p[i].y + (t * t * t - 2 * t * t + t) * h * p[i].slope +
          (3 * t * t - 2 * t * t * t) * p[i + 1].y + (t * t * t - t * t) * h * p[i + 1].slope;
  }
  if (p.size() > 1 && x < p[0].x) y = outside(p[0], p[1], p[0]);
  if (p.size() > 1 && x >= p.back().x) y = outside(p[p.size() - 2], p.back(), p.back());
  const Real low = number_at(a, 3), high = number_at(a, 4);
  out.parts = {low + y * (high - low)};
  out.size = fmaxl(1e-300L, fmaxl(fabsl(low), fmaxl(fabsl(high), fabsl(y * (high - low)))));
  // The curve's slope times what the input lost by its range.
  const Real lost =
      range == 0 ? 1 : (fabsl(number_at(a, 0)) + fabsl(number_at(a, 1))) / fabsl(range);
  out.condition = 1 + steepest * fmaxl(1, fmaxl(lost, fabsl(x))) * fabsl(high - low) / out.size;
  return out;
}

}  // namespace rigc::exact
