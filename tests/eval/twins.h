// SPDX-License-Identifier: MIT
// Slow, obvious scalar twins of what kernels use: 4 x 4 matrices in plain arrays, angles by std
// functions. They share no code with src/math, so that an error there shows.
#pragma once

#include <array>
#include <cmath>

#include "math/math.h"

namespace rigc::twin {

/// m[row][column]
using M = std::array<std::array<double, 4>, 4>;

inline M identity() {
  M m{};
  for (std::size_t i = 0; i < 4; ++i) m[i][i] = 1;
  return m;
}

inline M from(const math::Affine& a) {
  M m = identity();
  const math::Vec3 columns[] = {a.linear.x, a.linear.y, a.linear.z, a.origin};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t r = 0; r < 3; ++r) m[r][c] = columns[c][r];
  }
  return m;
}

inline math::Affine to_affine(const M& m) {
  math::Affine a;
  for (std::size_t r = 0; r < 3; ++r) {
    a.linear.x[r] = m[r][0];
    a.linear.y[r] = m[r][1];
    a.linear.z[r] = m[r][2];
    a.origin[r] = m[r][3];
  }
  return a;
}

inline M times(const M& a, const M& b) {
  M m{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t k = 0; k < 4; ++k) m[r][c] += a[r][k] * b[k][c];
    }
  }
  return m;
}

/// Gauss and Jordan with pivots.
inline M inverse(M a) {
  M out = identity();
  for (std::size_t c = 0; c < 4; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < 4; ++r) {
      if (std::fabs(a[r][c]) > std::fabs(a[pivot][c])) pivot = r;
    }
    std::swap(a[c], a[pivot]);
    std::swap(out[c], out[pivot]);
    const double by = a[c][c];
    for (std::size_t k = 0; k < 4; ++k) a[c][k] /= by, out[c][k] /= by;
    for (std::size_t r = 0; r < 4; ++r) {
      if (r == c) continue;
      const double factor = a[r][c];
      for (std::size_t k = 0; k < 4; ++k)
        a[r][k] -= factor * a[c][k], out[r][k] -= factor * out[c][k];
    }
  }
  return out;
}

/// Rotation about a coordinate axis (0 x, 1 y, 2 z).
inline M turn(int axis, double degrees) {
  const double a = degrees * 3.14159265358979323846 / 180;
  const auto i = static_cast<std::size_t>((axis + 1) % 3),
             j = static_cast<std::size_t>((axis + 2) % 3);
  M m = identity();
  m[i][i] = m[j][j] = std::cos(a);
  m[j][i] = std::sin(a);
  m[i][j] = -std::sin(a);
  return m;
}

/// Rotation about a unit axis, by Rodrigues' formula v cos + (k x v) sin + k (k.v)(1 - cos).
inline M turn(math::Vec3 k, double radians) {
  M m = identity();
  for (std::size_t c = 0; c < 3; ++c) {
    math::Vec3 v;
    v[c] = 1;
    const double along = k.x * v.x + k.y * v.y + k.z * v.z;
    const math::Vec3 side{k.y * v.z - k.z * v.y, k.z * v.x - k.x * v.z, k.x * v.y - k.y * v.x};
    for (std::size_t r = 0; r < 3; ++r) {
      m[r][c] = v[r] * std::cos(radians) + side[r] * std::sin(radians) +
                k[r] * along * (1 - std::cos(radians));
    }
  }
  return m;
}

/// Rotation of a quaternion by its axis and angle.
inline M turn(math::Quat q) {
  const double n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  if (n == 0) return identity();
  return turn(math::Vec3{q.x / n, q.y / n, q.z / n}, 2 * std::atan2(n, q.w));
}

inline M place(math::Vec3 t, const M& rotation, math::Vec3 s) {
  M m = rotation;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) m[r][c] *= s[c];
    m[r][3] = t[r];
  }
  return m;
}

inline math::Vec3 column(const M& m, std::size_t c) { return {m[0][c], m[1][c], m[2][c]}; }

/// Angle in radians of the rotation that is left between two rotations.
inline double angle_between(const M& a, const M& b) {
  double off = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) off += (a[r][c] - b[r][c]) * (a[r][c] - b[r][c]);
  }
  return std::sqrt(off / 2);
}

/// Gram and Schmidt: the rotation of a matrix without shear or zero columns.
inline M rotation_of(const M& m) {
  std::array<std::array<double, 3>, 3> c{};
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t r = 0; r < 3; ++r) c[k][r] = m[r][k];
    for (std::size_t before = 0; before < k; ++before) {
      double along = 0;
      for (std::size_t r = 0; r < 3; ++r) along += c[k][r] * c[before][r];
      for (std::size_t r = 0; r < 3; ++r) c[k][r] -= along * c[before][r];
    }
    double size = 0;
    for (std::size_t r = 0; r < 3; ++r) size += c[k][r] * c[k][r];
    for (std::size_t r = 0; r < 3; ++r) c[k][r] /= std::sqrt(size);
  }
  for (std::size_t r = 0; r < 3; ++r) {
    c[2][r] = c[0][(r + 1) % 3] * c[1][(r + 2) % 3] - c[0][(r + 2) % 3] * c[1][(r + 1) % 3];
  }
  M out = identity();
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t r = 0; r < 3; ++r) out[r][k] = c[k][r];
  }
  return out;
}

/// A part of the rotation from a to b: `t` of the angle about the same axis.
inline M part_way(const M& a, const M& b, double t) {
  M back = identity();
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) back[r][c] = a[c][r];
  }
  const M d = times(b, back);
  const math::Vec3 axis{d[2][1] - d[1][2], d[0][2] - d[2][0], d[1][0] - d[0][1]};
  const double twice_sine = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  const double angle = std::atan2(twice_sine, d[0][0] + d[1][1] + d[2][2] - 1);
  if (twice_sine < 1e-12) return a;
  return times(
      turn(math::Vec3{axis.x / twice_sine, axis.y / twice_sine, axis.z / twice_sine}, angle * t),
      a);
}

}  // namespace rigc::twin
