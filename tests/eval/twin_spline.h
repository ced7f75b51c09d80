// SPDX-License-Identifier: MIT
// The scalar twin of the spline kernel: Hermite's polynomials, turns by axis and angle, a walk
// along the straight pieces. The condition of its input is found by trying: all places and axes are
// moved a little. Test: tests/eval/twins_test.cpp
#pragma once

#include "eval/kernels/spline_table.h"
#include "tests/eval/twin_solvers.h"

namespace rigc::exact {

/// The arguments and the table, as the kernel reads them.
struct SplineInput {
  A base;
  Real preserve = 0, least = 0, most = 1;
  std::vector<A> controls;
  std::vector<Real> twists;
};

class SplineTwin {
 public:
  SplineTwin(const SplineInput& in, const Numbers& d) : in_(in), d_(d) {
    namespace t = eval::spline;
    for (std::size_t i = 0; i < in.controls.size(); ++i) {
      const std::size_t row = t::kRows + i * t::kControlRow;
      const M turned = orthonormal(in.controls[i].linear);
      const V x = vec3_at(d, row + t::kAxes), y = vec3_at(d, row + t::kAxes + 3);
      frames_.push_back(turned * M{x, y, cross(x, y)});
      directions_.push_back(turned * vec3_at(d, row + t::kDirection));
    }
    for (std::size_t i = 0; i < in.controls.size(); ++i) {
      const Real follows = d[t::kRows + i * t::kControlRow + t::kFollows];
      directions_[i] = directions_[i] * follows + natural(i) * (1 - follows);
    }
    for (std::size_t i = 0; i + 1 < in.controls.size(); ++i) {
      for (int k = 0; k < 4; ++k)
        pieces_.push_back(length(at(i, (k + 1) / 4.0L) - at(i, k / 4.0L)));
    }
    for (const Real piece : pieces_) total_ += piece;
    const M& m = in.base.linear;
    size_ = sqrtl((dot(m.x, m.x) + dot(m.y, m.y) + dot(m.z, m.z)) / 3);
    solve();
  }

  Real length_in_base() const { return total_ / size_; }
  const std::vector<A>& worlds() const { return worlds_; }
  Real total() const { return total_; }
  /// Of two neighbouring outputs, before lengths are kept.
  Real nearest() const { return nearest_; }

 private:
  struct Spot {
    V place, along;
    M frame;
    Real twist = 0;
  };

  V point(std::size_t i) const { return in_.controls[i].origin; }
  V chord(std::size_t i) const { return point(i + 1) - point(i); }

  /// Of the parabola through three neighbours by the lengths between them; at the ends of an arc.
  V natural(std::size_t i) const {
    const std::size_t last = in_.controls.size() - 1;
    if (last == 1) return unit(chord(0));
    if (i == 0 || i == last) {
      const V along = unit(chord(i == 0 ? 0 : last - 1));
      const V other = natural(i == 0 ? 1 : last - 1);
      return along * (2 * dot(other, along)) - other;
    }
    const Real a = length(chord(i - 1)), b = length(chord(i));
    return (unit(chord(i - 1)) * b + unit(chord(i)) * a) * (1 / (a + b));
  }

  V at(std::size_t i, Real t) const {
    const V leaving = directions_[i] * length(chord(i));
    const V arriving = directions_[i + 1] * length(chord(i));
    return point(i) * (2 * t * t * t - 3 * t * t + 1) + leaving * (t * t * t - 2 * t * t + t) +
           point(i + 1) * (3 * t * t - 2 * t * t * t) + arriving * (t * t * t - t * t);
  }
  V slope(std::size_t i, Real t) const {
    const V leaving = directions_[i] * length(chord(i));
    const V arriving = directions_[i + 1] * length(chord(i));
    return chord(i) * (6 * t - 6 * t * t) + leaving * (3 * t * t - 4 * t + 1) +
           arriving * (3 * t * t - 2 * t);
  }

  Spot spot(Real x) const {
    const std::size_t last = in_.controls.size() - 2;
    const std::size_t i = std::min(last, static_cast<std::size_t>(x));
    const Real t = x - static_cast<Real>(i);
    Spot found{at(i, t), unit(slope(i, t)), {}, 0};
    const Turn turned = axis_angle(frames_[i + 1] * transposed(frames_[i]));
    found.frame = turn(turned.axis, turned.angle * t) * frames_[i];
    if (!in_.twists.empty()) found.twist = in_.twists[i] * (1 - t) + in_.twists[i + 1] * t;
    return found;
  }

  static M frame_along(const Spot& spot, V along) {
    const M frame = shortest(spot.frame.x, along) * spot.frame;
    return turn(along, spot.twist * kDegree) * frame;
  }

  Real after(Real passed) const {
    Real x = 0;
    for (const Real piece : pieces_) {
      x += std::clamp(passed / piece, 0.0L, 1.0L) / 4;
      passed -= piece;
    }
    return x;
  }

  Real kept() const {
    const Real asked = std::clamp(in_.preserve, 0.0L, 1.0L), rest = d_[eval::spline::kLength];
    const Real ratio = rest > 1e-30L ? length_in_base() / rest : 1;
    const Real free = 1 + (ratio - 1) * (1 - asked);
    if ((free >= in_.least && free <= in_.most) || fabsl(ratio - 1) <= 1e-12L) return asked;
    const Real wanted = free < in_.least ? in_.least : in_.most;
    return std::clamp((ratio - wanted) / (ratio - 1), 0.0L, 1.0L);
  }

  void solve() {
    namespace t = eval::spline;
    const bool moves = d_[t::kMoves] != 0;
    const Real keeps = moves ? kept() : 0;
    std::vector<Spot> spots;
    std::vector<V> places, free;
    const Real rest = d_[t::kLength];
    const Real longer = rest > 1e-30L ? 1 + (length_in_base() / rest - 1) * (1 - keeps) : 1;
    std::vector<M> frames;
    const auto count = static_cast<std::size_t>(d_[t::kOutputs]);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t row = t::kRows + in_.controls.size() * t::kControlRow + k * t::kOutputRow;
      const Real fixed = d_[row] + d_[row + t::kPart];
      const Real passed = d_[row + t::kPassed] * size_;
      spots.push_back(spot(fixed * (1 - keeps) + after(passed) * keeps));
      const V along = spots.back().along;
      frames.push_back(frame_along(spots.back(), along));
      V place = spots.back().place + along * (fmaxl(0, passed - total_) * keeps) +
                frames.back() * (vec3_at(d_, row + t::kOffset) * size_);
      free.push_back(place);
      if (k > 0) {
        const V way = place - places.back();
        nearest_ = fminl(nearest_, length(way));
        const Real own = length(free[k] - free[k - 1]);
        const Real wanted = d_[row - t::kOutputRow + t::kBone] * size_ * longer;
        if (keeps > 0) place = places.back() + unit(way) * (own * (1 - keeps) + wanted * keeps);
        if (d_[t::kAims] != 0) frames[k - 1] = frame_along(spots[k - 1], unit(way));
      }
      places.push_back(place);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t row =
          t::kRows + in_.controls.size() * t::kControlRow + k * t::kOutputRow + t::kTurned;
      const M own{vec3_at(d_, row), vec3_at(d_, row + 3), vec3_at(d_, row + 6)};
      worlds_.push_back({scaled(frames[k] * own, {size_, size_, size_}), places[k]});
    }
  }

  const SplineInput& in_;
  const Numbers& d_;
  std::vector<M> frames_;
  std::vector<V> directions_;
  std::vector<Real> pieces_;
  Real total_ = 0, size_ = 1, nearest_ = 1e300L;
  std::vector<A> worlds_;
};

/// Everything moved by `by`, relative to `size` and to the axes, in the n-th of some directions.
inline SplineInput moved(SplineInput in, Real by, Real size, unsigned n) {
  unsigned state = n * 2654435761u + 1;
  const auto sign = [&] {
    state = state * 1664525u + 1013904223u;
    return by * ((state >> 16 & 1) != 0 ? 1 : -1);
  };
  const auto move = [&](A& a, Real places) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Real axis = length(a.linear[i]);
      for (std::size_t c = 0; c < 3; ++c) a.linear[i][c] += axis * sign();
      a.origin[i] += places * sign();
    }
  };
  move(in.base, 0);
  for (A& control : in.controls) move(control, size);
  return in;
}

inline Result spline(const Arguments& a, const Numbers& d) {
  namespace t = eval::spline;
  const auto count = static_cast<std::size_t>(d[t::kCount]);
  SplineInput in;
  in.base = matrix_at(a, t::kBase);
  in.preserve = number_at(a, t::kPreserve);
  in.least = number_at(a, t::kLeast);
  in.most = number_at(a, t::kMost);
  for (std::size_t i = 0; i < count; ++i) in.controls.push_back(matrix_at(a, t::kControls + i));
  for (std::size_t i = t::kControls + count; i < a.size(); ++i)
    in.twists.push_back(number_at(a, i));
  const SplineTwin twin(in, d);
  Result out;
  out.size = twin.total();
  for (const A& control : in.controls) out.size = fmaxl(out.size, length(control.origin));
  for (const A& world : twin.worlds()) out.size = fmaxl(out.size, length(world.origin));
  const Real in_base = twin.length_in_base(), rest = d[t::kLength];
  out.parts = {Ratio{in_base}, Ratio{rest > 1e-30L ? in_base / rest : 1}};
  for (const A& world : twin.worlds()) out.parts.push_back(world);
  constexpr Real kStep = 1e-9L;
  for (unsigned n = 0; n < 6; ++n) {
    const SplineInput other_in = moved(in, kStep, out.size, n);
    const SplineTwin other(other_in, d);
    Real most = fabsl(other.length_in_base() / in_base - 1);
    for (std::size_t k = 0; k < twin.worlds().size(); ++k) {
      const A &was = twin.worlds()[k], &is = other.worlds()[k];
      most = fmaxl(most, length(is.origin - was.origin) / out.size);
      for (std::size_t i = 0; i < 3; ++i)
        most = fmaxl(most, length(is.linear[i] - was.linear[i]) / length(was.linear[i]));
    }
    out.condition = fmaxl(out.condition, most / kStep);
  }
  // The direction between outputs that are near each other.
  if (d[t::kAims] != 0 || d[t::kMoves] != 0)
    out.condition = fmaxl(out.condition, out.size / fmaxl(twin.nearest(), 1e-300L));
  out.certain = out.condition < 1e5L;
  return out;
}

}  // namespace rigc::exact
