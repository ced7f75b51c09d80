// SPDX-License-Identifier: MIT
// Polylines that shapes are made of: arcs, smooth curves, copies around and across axes.
// Test: tests/catalog/polyline_test.cpp
#pragma once

#include <vector>

#include "catalog/shape.h"

namespace rigc::catalog {

using Polyline = std::vector<Point>;

/// An arc around an axis. Angles are in degrees, from the front (+Z) toward +X around Y, from up
/// (+Y) toward +X around Z, from up toward +Z around X.
struct Arc {
  double radius = 0.5;
  Point centre{0, 0, 0};
  char axis = 'y';
  int segments = 32;
  double from = 0, to = 360;
};

/// `segments` + 1 points; a full circle repeats its first point exactly.
Polyline polyline(const Arc& arc);

/// A Catmull-Rom curve through the points, closed where the last point repeats the first; six
/// segments between two points.
Polyline smooth(const Polyline& points);

/// Turned around Y by `index` / `count` of a turn.
Polyline turned(const Polyline& points, int index, int count);

/// Mirrored across the plane at right angles to axis 0, 1 or 2.
Polyline mirrored(const Polyline& points, std::size_t axis);

}  // namespace rigc::catalog
