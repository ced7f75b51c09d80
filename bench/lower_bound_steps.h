// SPDX-License-Identifier: MIT
// The loop of the lower bound over vectors of one type, for the files that are compiled for one
// instruction set each.
#pragma once

#include "bench/lower_bound.h"

namespace {

using rigc::bench::BoundHierarchy;
using rigc::bench::kBoundLanes;

template <class Vector, class Number>
inline Vector load(const Number* at) {
  Vector value;
  __builtin_memcpy(&value, at, sizeof(value));
  return value;
}

template <class Vector, class Number>
inline void store(Number* at, Vector value) {
  __builtin_memcpy(at, &value, sizeof(value));
}

/// One transform in as many frames as a vector has: `world` gets the columns of parent * T * R;
/// `parent` null: none.
template <class Vector, class Number>
inline void step(const Number* q, const Number* t, const Number* parent, Number* world) {
  constexpr std::size_t kRow = kBoundLanes;
  const Vector x = load<Vector>(q), y = load<Vector>(q + kRow);
  const Vector z = load<Vector>(q + 2 * kRow), w = load<Vector>(q + 3 * kRow);
  const Vector x2 = x + x, y2 = y + y, z2 = z + z;
  const Vector xx = x * x2, yy = y * y2, zz = z * z2, xy = x * y2, xz = x * z2, yz = y * z2;
  const Vector wx = w * x2, wy = w * y2, wz = w * z2;
  const Vector one = Vector{} + Number(1);
  const Vector m[4][3] = {{one - (yy + zz), xy + wz, xz - wy},
                          {xy - wz, one - (xx + zz), yz + wx},
                          {xz + wy, yz - wx, one - (xx + yy)},
                          {Vector{} + t[0], Vector{} + t[1], Vector{} + t[2]}};
  if (!parent) {
    for (std::size_t i = 0; i < 12; ++i) store(world + i * kRow, m[i / 3][i % 3]);
    return;
  }
  for (std::size_t r = 0; r < 3; ++r) {
    const Vector px = load<Vector>(parent + r * kRow), py = load<Vector>(parent + (3 + r) * kRow);
    const Vector pz = load<Vector>(parent + (6 + r) * kRow);
    const Vector origin = load<Vector>(parent + (9 + r) * kRow);
    for (std::size_t c = 0; c < 3; ++c)
      store(world + (3 * c + r) * kRow, px * m[c][0] + py * m[c][1] + pz * m[c][2]);
    store(world + (9 + r) * kRow, px * m[3][0] + py * m[3][1] + pz * m[3][2] + origin);
  }
}

template <class Vector, class Number>
inline void run(const BoundHierarchy<Number>& h) {
  constexpr std::size_t kStep = sizeof(Vector) / sizeof(Number);
  for (std::size_t i = 0; i < h.count; ++i) {
    const std::int32_t above = h.parents[i];
    const Number* parent =
        above < 0 ? nullptr : h.worlds + static_cast<std::size_t>(above) * 12 * kBoundLanes;
    for (std::size_t lane = 0; lane < kBoundLanes; lane += kStep)
      step<Vector>(h.rotations + i * 4 * kBoundLanes + lane, h.translations + 3 * i,
                   parent ? parent + lane : nullptr, h.worlds + i * 12 * kBoundLanes + lane);
  }
}

}  // namespace
