// SPDX-License-Identifier: MIT
// Remaps a number through a curve of points. The segment after a point has the point's
// interpolation: none holds its value, linear, smooth eases in and out (3t^2 - 2t^3), spline is a
// monotone cubic (Fritsch and Butland 1984; its tangents are in the table).
// Test: tests/eval/remap_test.cpp
#include <cmath>

#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

// A row of the table: position, value, interpolation, tangent.
constexpr std::size_t kRow = 4;
enum Interpolation { kNone, kLinear, kSmooth, kSpline };

double on_segment(const double* a, const double* b, double t, double length) {
  const double rise = b[1] - a[1];
  switch (static_cast<int>(a[2])) {
    case kLinear:
      return a[1] + rise * t;
    case kSmooth:
      return a[1] + rise * t * t * (3 - 2 * t);
    case kSpline: {
      const double u = 1 - t;
      return a[1] * u * u * (1 + 2 * t) + b[1] * t * t * (3 - 2 * t) +
             length * t * u * (u * a[3] - t * b[3]);
    }
    default:
      return t < 1 ? a[1] : b[1];
  }
}

// Slope of a segment at one of its ends.
double end_slope(const double* a, const double* b, const double* at) {
  const double length = b[0] - a[0];
  const int kind = static_cast<int>(a[2]);
  if (kind == kSpline) return at[3];
  return kind == kLinear && length > 0 ? (b[1] - a[1]) / length : 0;
}

double curve(const double* points, std::size_t count, double x, bool held) {
  if (count == 0) return x;
  const double* first = points;
  const double* last = points + (count - 1) * kRow;
  if (count == 1) return first[1];
  if (x < first[0]) {
    return first[1] + (held ? 0 : (x - first[0]) * end_slope(first, first + kRow, first));
  }
  if (x >= last[0])
    return last[1] + (held ? 0 : (x - last[0]) * end_slope(last - kRow, last, last));
  const double* a = points;
  while (x >= a[kRow]) a += kRow;
  const double length = a[kRow] - a[0];
  return on_segment(a, a + kRow, (x - a[0]) / length, length);
}

}  // namespace

void remap(const Call& call) {
  const double* input = call.in(0);
  const double* input_min = call.in(1);
  const double* input_max = call.in(2);
  const double* output_min = call.in(3);
  const double* output_max = call.in(4);
  const bool held = call.data[0] != 0;
  const auto count = static_cast<std::size_t>(call.data[1]);
  double* out = call.result();
  for (int lane = 0; lane < kLanes; ++lane) {
    const double range = input_max[lane] - input_min[lane];
    double x = range != 0 ? (input[lane] - input_min[lane]) / range : 0;
    if (!std::isfinite(x)) x = 0;
    if (held) x = x < 0 ? 0 : x > 1 ? 1 : x;
    const double y = curve(call.data + 2, count, x, held);
    const double value = output_min[lane] + y * (output_max[lane] - output_min[lane]);
    out[lane] = std::isfinite(value) ? value : 0;
  }
}

}  // namespace rigc::eval
