// SPDX-License-Identifier: MIT
// Places on a curve, its lengths, and the nearest place. Test: tests/math/spline_test.cpp
#include "math/spline.h"

#include <cassert>

#include "math/generic/spline.h"

namespace rigc::math {
namespace {

/// Places of a segment that the search for the nearest begins with, and halvings of what is left.
constexpr int kTried = 16;
constexpr int kHalvings = 50;

struct Spot {
  std::size_t segment;
  double t;
};

Spot spot(double x, std::size_t points) {
  const double last = static_cast<double>(points - 1);
  const double inside = x > 0 ? (x < last ? x : last) : 0;
  const auto whole = static_cast<std::size_t>(inside);
  const std::size_t segment = whole + 1 < points ? whole : points - 2;
  return {segment, inside - static_cast<double>(segment)};
}

generic::SegmentOf<double> segment_of(const std::vector<Vec3>& points,
                                      const std::vector<Vec3>& directions, std::size_t i) {
  const double chord = length(points[i + 1] - points[i]);
  return {points[i], directions[i] * chord, points[i + 1], directions[i + 1] * chord};
}

}  // namespace

Spline::Spline(std::vector<Vec3> points) : points_(std::move(points)) {
  assert(points_.size() >= 2);
  std::vector<Vec3> chords;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i)
    chords.push_back(points_[i + 1] - points_[i]);
  const auto unit = [&](std::size_t i) { return generic::unit(chords[i]); };
  directions_.resize(points_.size());
  for (std::size_t i = 1; i < chords.size(); ++i) {
    directions_[i] = generic::direction_between(unit(i - 1), math::length(chords[i - 1]), unit(i),
                                                math::length(chords[i]));
  }
  const bool straight = chords.size() == 1;
  const std::size_t last = chords.size() - 1;
  directions_.front() = straight ? unit(0) : generic::direction_at_end(directions_[1], unit(0));
  directions_.back() =
      straight ? unit(0) : generic::direction_at_end(directions_[last], unit(last));
}

Vec3 Spline::at(double x) const {
  const Spot s = spot(x, points_.size());
  return generic::combined(segment_of(points_, directions_, s.segment), generic::place_basis(s.t));
}

Vec3 Spline::slope(double x) const {
  const Spot s = spot(x, points_.size());
  return generic::combined(segment_of(points_, directions_, s.segment), generic::slope_basis(s.t));
}

double Spline::passed(double x) const {
  const Spot s = spot(x, points_.size());
  double sum = 0;
  for (std::size_t i = 0; i <= s.segment; ++i) {
    for (int k = 0; k < generic::kSplinePieces; ++k) {
      const double start = static_cast<double>(i) + static_cast<double>(k) / generic::kSplinePieces;
      const double step = 1.0 / generic::kSplinePieces;
      const double piece = math::length(at(start + step) - at(start));
      const double part = (x - start) * generic::kSplinePieces;
      if (part > 0) sum += piece * (part < 1 ? part : 1);
    }
  }
  return sum;
}

double Spline::nearest(Vec3 point) const {
  const auto away = [&](double x) { return math::length(at(x) - point); };
  const int tries = kTried * static_cast<int>(points_.size() - 1);
  double best = 0;
  for (int i = 1; i <= tries; ++i) {
    const double x = static_cast<double>(i) / kTried;
    if (away(x) < away(best)) best = x;
  }
  double step = 1.0 / kTried;
  for (int i = 0; i < kHalvings; ++i) {
    step *= 0.5;
    const double low = best - step > 0 ? best - step : 0, high = best + step;
    if (away(low) < away(best)) {
      best = low;
    } else if (high <= static_cast<double>(points_.size() - 1) && away(high) < away(best)) {
      best = high;
    }
  }
  return best;
}

}  // namespace rigc::math
