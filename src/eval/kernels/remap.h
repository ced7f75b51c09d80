// SPDX-License-Identifier: MIT
// Remaps a number through a curve of points. The segment after a point has the point's
// interpolation: none holds its value, linear, smooth eases in and out (3t^2 - 2t^3), spline is a
// monotone cubic (Fritsch and Butland 1984; its tangents are in the table).
// Test: tests/eval/remap_test.cpp
#pragma once

#include "eval/kernels/numbers.h"

namespace rigc::eval {
namespace {

/// input, its range, output's range; data: clamp, count, points -> number
struct Remap {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const double* d = lanes.data();
    const bool held = d[0] != 0;
    const Real low = lanes.number(1);
    const Real range = lanes.number(2) - low;
    const auto some = range != 0.0;
    const Real ratio = (lanes.number(0) - low) / select(some, range, Real(1.0));
    Real x = select(some & (magnitude(ratio) <= generic::kLargest), ratio, Real(0.0));
    if (held) x = generic::clamped(x, 0.0, 1.0);
    const Real y = curve(d + 2, static_cast<std::size_t>(d[1]), x, held);
    const Real value = lanes.number(3) + y * (lanes.number(4) - lanes.number(3));
    lanes.put(0, select(magnitude(value) <= generic::kLargest, value, Real(0.0)));
  }

 private:
  // A row of the table: position, value, interpolation, tangent.
  static constexpr std::size_t kRow = 4;
  enum Interpolation { kNone, kLinear, kSmooth, kSpline };

  RIGC_INLINE static Real on_segment(const double* a, const double* b, Real t, double length) {
    const double rise = b[1] - a[1];
    const Real u = 1.0 - t;
    switch (static_cast<int>(a[2])) {
      case kLinear:
        return a[1] + rise * t;
      case kSmooth:
        return a[1] + rise * t * t * (3.0 - 2.0 * t);
      case kSpline:
        return a[1] * u * u * (1.0 + 2.0 * t) + b[1] * t * t * (3.0 - 2.0 * t) +
               length * t * u * (u * a[3] - t * b[3]);
      default:
        return select(t < 1.0, Real(a[1]), Real(b[1]));
    }
  }

  /// Slope of a segment at one of its ends.
  RIGC_INLINE static double end_slope(const double* a, const double* b, const double* at) {
    const double length = b[0] - a[0];
    const int kind = static_cast<int>(a[2]);
    if (kind == kSpline) return at[3];
    return kind == kLinear && length > 0 ? (b[1] - a[1]) / length : 0;
  }

  RIGC_INLINE static Real curve(const double* points, std::size_t count, Real x, bool held) {
    if (count == 0) return x;
    const double* last = points + (count - 1) * kRow;
    if (count == 1) return Real(points[1]);
    const double before = held ? 0 : end_slope(points, points + kRow, points);
    const double after = held ? 0 : end_slope(last - kRow, last, last);
    Real y = points[1] + (x - points[0]) * before;
    for (const double* a = points; a != last; a += kRow) {
      const auto here = x >= a[0];
      if (!any(here)) break;
      const double length = a[kRow] - a[0];
      y = select(here, on_segment(a, a + kRow, (x - a[0]) / length, length), y);
    }
    return select(x >= last[0], last[1] + (x - last[0]) * after, y);
  }
};

}  // namespace
}  // namespace rigc::eval
