// SPDX-License-Identifier: MIT
// The line along a surface on which something lies: where one texture coordinate stays the same.
// Test: tests/modules/surface_line_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/math.h"
#include "tags/tags.h"

namespace rigc::modules {

/// A place on a surface, with unit vectors.
struct SurfacePlace {
  math::Vec3 point;
  math::Vec3 along;   ///< of the line
  math::Vec3 normal;  ///< of the surface, at a right angle to it
};

/// Points of a line in the planes of the triangles that it crosses.
class SurfaceLine {
 public:
  /// Two points or more, no two equal ones after another; `normals`: of the surface there, not zero
  /// for all. `closed`: the last point is the first.
  SurfaceLine(std::vector<math::Vec3> points, std::vector<math::Vec3> normals, bool closed);

  bool closed() const { return closed_; }
  double length() const { return passed_.back(); }
  /// The place at a part 0..1 of the length; beyond, a closed line goes round and another has its
  /// ends.
  SurfacePlace at(double part) const;
  /// The part of its length at which it is nearest to a point; of several the first.
  double nearest(math::Vec3 point) const;

 private:
  struct Segment {
    std::size_t index;  ///< of its first point
    double part;        ///< of the segment
  };
  Segment segment_at(double part) const;
  math::Vec3 point_at(double part) const;

  std::vector<math::Vec3> points_, normals_;
  std::vector<double> passed_;  ///< length from the start to each point
  bool closed_ = false;
};

/// The line on which the texture coordinate across is at `row`, 0 its least and 1 its greatest in
/// an island of the texture, as the one along rises. `direction`: of the line, "u", "v" or "auto",
/// the one in which it is longer. Where it consists of several pieces this is the longest one.
/// Nothing where the surface has no such line.
std::optional<SurfaceLine> line_on(const tags::Surface& surface, const std::string& direction,
                                   double row);

}  // namespace rigc::modules
