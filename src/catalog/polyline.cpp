// SPDX-License-Identifier: MIT
// Arcs, smooth curves and copies. Test: tests/catalog/polyline_test.cpp
#include "catalog/polyline.h"

#include "math/math.h"

namespace rigc::catalog {
namespace {

constexpr int kCurveSegments = 6;

struct SinCos {
  double sin, cos;
};

/// Of degrees, with the rounding residues of quarter turns removed, so that they stand in data as
/// 0.
SinCos sin_cos(double degrees) {
  const double radians = math::radians(degrees);
  const auto clean = [](double x) { return x > -1e-12 && x < 1e-12 ? 0.0 : x; };
  const double sine = clean(math::sin(radians));
  const double cosine = clean(math::cos(radians));
  return {sine, cosine};
}

Point at(const Arc& arc, double degrees) {
  const SinCos unit = sin_cos(degrees);
  const double s = arc.radius * unit.sin, c = arc.radius * unit.cos;
  const Point& o = arc.centre;
  switch (arc.axis) {
    case 'x':
      return {o[0], o[1] + c, o[2] + s};
    case 'z':
      return {o[0] + s, o[1] + c, o[2]};
    default:
      return {o[0] + s, o[1], o[2] + c};
  }
}

/// Between b and c, `t` in 0..1. Source: Catmull and Rom 1974, uniform knots.
Point catmull_rom(const Point& a, const Point& b, const Point& c, const Point& d, double t) {
  Point point{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double linear = c[i] - a[i];
    const double square = 2 * a[i] - 5 * b[i] + 4 * c[i] - d[i];
    const double cube = 3 * (b[i] - c[i]) + d[i] - a[i];
    point[i] = b[i] + 0.5 * t * (linear + t * (square + t * cube));
  }
  return point;
}

}  // namespace

Polyline polyline(const Arc& arc) {
  Polyline points;
  const double step = (arc.to - arc.from) / arc.segments;
  for (int i = 0; i < arc.segments; ++i) points.push_back(at(arc, arc.from + step * i));
  const bool full = arc.to - arc.from == 360 || arc.to - arc.from == -360;
  points.push_back(full ? points.front() : at(arc, arc.to));
  return points;
}

Polyline smooth(const Polyline& points) {
  const std::size_t last = points.size() - 1;
  const bool closed = points.front() == points.back() && last > 1;
  Polyline result;
  for (std::size_t i = 0; i < last; ++i) {
    const Point& before = i > 0 ? points[i - 1] : closed ? points[last - 1] : points[0];
    const Point& after = i + 2 <= last ? points[i + 2] : closed ? points[1] : points[last];
    for (int step = 0; step < kCurveSegments; ++step) {
      const double t = static_cast<double>(step) / kCurveSegments;
      result.push_back(catmull_rom(before, points[i], points[i + 1], after, t));
    }
  }
  result.push_back(points.back());
  return result;
}

Polyline turned(const Polyline& points, int index, int count) {
  if (index == 0) return points;
  const SinCos turn = sin_cos(360.0 * index / count);
  Polyline result;
  for (const Point& p : points) {
    const double x = p[0] * turn.cos + p[2] * turn.sin;
    const double z = p[2] * turn.cos - p[0] * turn.sin;
    result.push_back({x, p[1], z});
  }
  return result;
}

Polyline mirrored(const Polyline& points, std::size_t axis) {
  Polyline result = points;
  for (Point& point : result) point[axis] = point[axis] == 0 ? 0 : -point[axis];
  return result;
}

}  // namespace rigc::catalog
