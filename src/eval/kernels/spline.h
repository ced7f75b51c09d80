// SPDX-License-Identifier: MIT
// Frames along a curve through controls. Between two controls the frame is the one's turned toward
// the other's (so twist is spread evenly), then swung onto the curve's direction by the shortest
// turn. Fixed work: lengths are those of straight pieces. Test: tests/eval/spline_test.cpp
#pragma once

#include "eval/kernels/lanes.h"
#include "eval/kernels/spline_table.h"
#include "math/generic/spline.h"

namespace rigc::eval {
namespace {
namespace spline_curve {

using namespace rigc::eval::spline;
using Segment = generic::SegmentOf<Real>;
using Basis = generic::BasisOf<Real>;
using generic::kSplinePieces;

/// 1 / length, for lengths whose squares neither overflow nor vanish.
RIGC_INLINE Mask is_plain(Real squares) {
  const auto there = squares > 1e-60, bounded = squares < 1e200;
  return there & bounded;
}
RIGC_INLINE Real inverse_root(Mask plain, Real squares) {
  return 1.0 / math::root(select(plain, squares, Real(1.0)));
}

RIGC_INLINE Vec3 unit(Vec3 v, Vec3 fallback) {
  const Real squares = dot(v, v);
  const Mask plain = is_plain(squares);
  const Vec3 found = v * inverse_root(plain, squares);
  return any(!plain) ? select(plain, found, generic::normalised(v, fallback)) : found;
}

/// generic::orthonormal, with less work where nothing is lost.
RIGC_INLINE Mat3 rotation_of(const Mat3& m) {
  const Real xx = dot(m.x, m.x), yy = dot(m.y, m.y);
  const Vec3 x = m.x * inverse_root(is_plain(xx), xx);
  const Vec3 side = m.y - x * dot(m.y, x);
  const Real rest = dot(side, side);
  const auto plain_x = is_plain(xx), plain_y = is_plain(yy), upright = rest > 0.25 * yy;
  const auto clear = plain_x & plain_y & upright;
  const Vec3 y = side * inverse_root(clear, rest);
  const Mat3 found{x, y, cross(x, y)};
  return any(!clear) ? select(clear, found, generic::orthonormal(m)) : found;
}

/// A turn about an axis, as what it does to x and y of a frame: parts along the axis and across it.
struct Turn {
  Real angle;  ///< radians
  Vec3 x_along, x_across, x_beside, y_along, y_across, y_beside;
};

struct Axes {
  Vec3 x, y;
};

/// Writes in place: the compilers copy what is returned.
RIGC_INLINE void set_turn(Turn& to, const Axes& a, const Axes& b) {
  const Vec3 az = cross(a.x, a.y), bz = cross(b.x, b.y);
  const Vec3 twice_sine = cross(a.x, b.x) + cross(a.y, b.y) + cross(az, bz);
  const Real twice_cosine = dot(a.x, b.x) + dot(a.y, b.y) + dot(az, bz) - 1.0;
  Vec3 axis = generic::unit(twice_sine);
  Real angle = generic::atan2(dot(axis, twice_sine), twice_cosine);
  // The sine of what is nearly a half turn says little about the axis.
  const auto far = twice_cosine < -1.0;
  if (any(far)) {
    const Quat q = generic::quaternion(Mat3{a.x.x * b.x + a.y.x * b.y + az.x * bz,
                                            a.x.y * b.x + a.y.y * b.y + az.y * bz,
                                            a.x.z * b.x + a.y.z * b.y + az.z * bz});
    const Vec3 sine{q.x, q.y, q.z};
    const Vec3 found = generic::unit(sine);
    axis = select(far, found, axis);
    angle = select(far, 2.0 * generic::atan2(dot(found, sine), q.w), angle);
  }
  const Vec3 x_along = axis * dot(a.x, axis), y_along = axis * dot(a.y, axis);
  to.angle = angle;
  to.x_along = x_along;
  to.x_across = a.x - x_along;
  to.x_beside = cross(axis, a.x);
  to.y_along = y_along;
  to.y_across = a.y - y_along;
  to.y_beside = cross(axis, a.y);
}

/// The frame after a part of the turn.
RIGC_INLINE Axes turned(const Turn& turn, Real part) {
  const auto by = generic::sine_cosine(turn.angle * part);
  return {turn.x_along + turn.x_across * by.cosine + turn.x_beside * by.sine,
          turn.y_along + turn.y_across * by.cosine + turn.y_beside * by.sine};
}

/// Room for what is written before it is read: clearing it first would take as long as a segment.
template <class T>
union Unset {
  T value;
  RIGC_INLINE Unset() {}
};

/// Up to N controls.
template <int N>
struct Curve {
  int count = 0;
  Vec3 at[N], chords[N], directions[N];  ///< chords: unit, to the next
  Real chord_lengths[N];
  Axes axes[N];
  Turn turns[N];
  Real twists[N];  ///< degrees
};

/// Of the points alone.
template <int N>
RIGC_INLINE Vec3 inner_direction(const Curve<N>& c, int i) {
  return generic::direction_between(c.chords[i - 1], c.chord_lengths[i - 1], c.chords[i],
                                    c.chord_lengths[i]);
}
template <int N>
RIGC_INLINE Vec3 own_direction(const Curve<N>& c, int i) {
  const int last = c.count - 1;
  if (last == 1) return c.chords[0];
  if (i == 0) return generic::direction_at_end(inner_direction(c, 1), c.chords[0]);
  if (i == last) return generic::direction_at_end(inner_direction(c, i - 1), c.chords[i - 1]);
  return inner_direction(c, i);
}

template <int N>
RIGC_INLINE void read(Curve<N>& c, const Lanes& lanes) {
  const double* d = lanes.data();
  c.count = static_cast<int>(d[kCount]);
  const auto count = static_cast<std::size_t>(c.count);
  for (std::size_t i = 0; i < count; ++i) {
    const double* row = d + kRows + i * kControlRow;
    const Affine control = lanes.affine(kControls + i);
    const Mat3 rotation = rotation_of(control.linear);
    c.at[i] = control.origin;
    c.directions[i] = rotation * vec3_at(row + kDirection);
    c.axes[i] = {rotation * vec3_at(row + kAxes), rotation * vec3_at(row + kAxes + 3)};
    c.twists[i] = d[kTwisted] != 0 ? lanes.number(kControls + count + i) : Real(0.0);
  }
  for (int i = 0; i + 1 < c.count; ++i) {
    const Vec3 chord = c.at[i + 1] - c.at[i];
    c.chords[i] = unit(chord, Vec3{});
    c.chord_lengths[i] = dot(c.chords[i], chord);
    set_turn(c.turns[i], c.axes[i], c.axes[i + 1]);
  }
  for (int i = 0; i < c.count; ++i) {
    const double follows = d[kRows + static_cast<std::size_t>(i) * kControlRow + kFollows];
    if (follows != 1) c.directions[i] = lerp(own_direction(c, i), c.directions[i], follows);
  }
}

template <int N>
RIGC_INLINE Segment segment_of(const Curve<N>& c, int i) {
  const Real chord = c.chord_lengths[i];
  return {c.at[i], c.directions[i] * chord, c.at[i + 1], c.directions[i + 1] * chord};
}

/// Lengths of the straight pieces, and where each begins on the way along the curve.
template <int N>
struct Way {
  int count = 0;
  Real starts[N * kSplinePieces], inverses[N * kSplinePieces];
  Real length;
};

template <int N>
RIGC_INLINE void measure(Way<N>& way, const Curve<N>& c, bool moves) {
  way.length = Real(0.0);
  way.count = 0;
  for (int i = 0; i + 1 < c.count; ++i) {
    const Segment segment = segment_of(c, i);
    Vec3 before = segment.from;
    for (int k = 1; k <= kSplinePieces; ++k) {
      const double t = static_cast<double>(k) / kSplinePieces;
      const Vec3 here = k == kSplinePieces
                            ? segment.to
                            : generic::combined(segment, generic::place_basis(Real(t)));
      const Real piece = generic::length(here - before);
      if (moves) {
        way.starts[way.count] = way.length;
        way.inverses[way.count++] = 1.0 / select(piece > 1e-30, piece, Real(1e-30));
      }
      way.length = way.length + piece;
      before = here;
    }
  }
}

/// Where the curve has this length behind it, in segments.
template <int N>
RIGC_INLINE Real place_after(const Way<N>& way, Real passed) {
  Real pieces(0.0);
  for (int i = 0; i < way.count; ++i)
    pieces = pieces + generic::clamped((passed - way.starts[i]) * way.inverses[i], 0.0, 1.0);
  return pieces * (1.0 / kSplinePieces);
}

/// A place of the curve, with what the frame there is made of.
struct Spot {
  Vec3 at, slope;
  Axes axes;
  Real twist;
};

template <int N>
RIGC_INLINE Spot spot_at(const Curve<N>& c, int segment, Real part, const Basis& place,
                         const Basis& slope) {
  const Segment s = segment_of(c, segment);
  return {generic::combined(s, place), generic::combined(s, slope), turned(c.turns[segment], part),
          c.twists[segment] + (c.twists[segment + 1] - c.twists[segment]) * part};
}

RIGC_INLINE Basis basis_at(const double* d) {
  return {Real(d[0]), Real(d[1]), Real(d[2]), Real(d[3])};
}

template <int N>
RIGC_INLINE Spot fixed_spot(const Curve<N>& c, const double* row) {
  // At a control the frame is its own.
  const int segment = static_cast<int>(row[kSegment]);
  if (row[kPart] == 0 || row[kPart] == 1) {
    const int at = row[kPart] == 0 ? segment : segment + 1;
    return {c.at[at], c.directions[at] * c.chord_lengths[segment], c.axes[at], c.twists[at]};
  }
  return spot_at(c, segment, Real(row[kPart]), basis_at(row + kPlaceBasis),
                 basis_at(row + kSlopeBasis));
}

RIGC_INLINE Turn select_turn(Mask m, const Turn& a, const Turn& b) {
  return {select(m, a.angle, b.angle),       select(m, a.x_along, b.x_along),
          select(m, a.x_across, b.x_across), select(m, a.x_beside, b.x_beside),
          select(m, a.y_along, b.y_along),   select(m, a.y_across, b.y_across),
          select(m, a.y_beside, b.y_beside)};
}

/// At `x` segments, another segment in each lane.
template <int N>
RIGC_INLINE Spot moving_spot(const Curve<N>& c, Real x) {
  Segment s = segment_of(c, 0);
  Turn turn = c.turns[0];
  Real start(0.0), from = c.twists[0], to = c.twists[1];
  for (int i = 1; i + 1 < c.count; ++i) {
    const Real first(static_cast<double>(i));
    const auto here = x >= first;
    if (!any(here)) break;
    const Segment other = segment_of(c, i);
    s = {select(here, other.from, s.from), select(here, other.leaving, s.leaving),
         select(here, other.to, s.to), select(here, other.arriving, s.arriving)};
    turn = select_turn(here, c.turns[i], turn);
    start = select(here, first, start);
    from = select(here, c.twists[i], from);
    to = select(here, c.twists[i + 1], to);
  }
  const Real t = x - start;
  return {generic::combined(s, generic::place_basis(t)),
          generic::combined(s, generic::slope_basis(t)), turned(turn, t), from + (to - from) * t};
}

/// The frame of a spot whose x is unit vector `along`.
RIGC_INLINE Mat3 frame_of(const Spot& spot, Vec3 along, bool twisted) {
  Vec3 y = generic::swung(spot.axes.y, spot.axes.x, along);
  Vec3 z = cross(along, y);
  if (twisted) {
    const auto by = generic::sine_cosine_degrees(spot.twist);
    y = y * by.cosine + z * by.sine;
    z = cross(along, y);
  }
  return {along, y, z};
}

}  // namespace spline_curve

/// Arguments and table: spline_table.h -> the curve's length in the base's units, the same relative
/// to rest, worlds of the outputs.
struct Spline {
  RIGC_INLINE static void run(const Lanes& lanes) {
    if (lanes.data()[spline::kCount] <= 8) {
      run_up_to<8>(lanes);
    } else {
      run_up_to<spline::kMostControls>(lanes);
    }
  }

 private:
  template <int N>
  RIGC_INLINE static void run_up_to(const Lanes& lanes) {
    using namespace spline_curve;
    const double* d = lanes.data();
    Unset<Curve<N>> curve_space;
    Curve<N>& curve = curve_space.value;
    read(curve, lanes);
    const bool moves = d[kMoves] != 0;
    Unset<Way<N>> way_space;
    Way<N>& way = way_space.value;
    const Real size = size_of(lanes.affine(kBase).linear);
    Real ratio(1.0), preserve(0.0);
    if (moves || d[kMeasures] != 0) {
      measure(way, curve, moves);
      ratio = put_lengths(lanes, way.length, size);
      preserve = preserve_of(lanes, ratio);
    }
    Outputs outputs(lanes, curve.count, size, 1.0 + (ratio - 1.0) * (1.0 - preserve));
    const auto count = static_cast<std::size_t>(d[kOutputs]);
    for (std::size_t k = 0; k < count; ++k) {
      const double* row = outputs.row(k);
      if (!moves) {
        outputs.add(k, fixed_spot(curve, row), Real(0.0), Real(0.0));
        continue;
      }
      const Real passed = row[kPassed] * size;
      const Real fixed(row[kSegment] + row[kPart]);
      const Real x = fixed + (place_after(way, passed) - fixed) * preserve;
      const Real beyond = passed - way.length;
      outputs.add(k, moving_spot(curve, x), select(beyond > 0.0, beyond * preserve, Real(0.0)),
                  preserve);
    }
    outputs.finish(count);
  }

  /// Root mean square of the columns.
  RIGC_INLINE static Real size_of(const Mat3& m) {
    const Real x = generic::length(m.x), y = generic::length(m.y), z = generic::length(m.z);
    return generic::length(Vec3{x, y, z}) * 0.57735026918962576;
  }

  /// How much of the lengths at rest is kept, so that the whole is not shorter than `least` nor
  /// longer than `most` times its length at rest.
  RIGC_INLINE static Real preserve_of(const Lanes& lanes, Real ratio) {
    const Real asked = generic::clamped(lanes.number(spline::kPreserve), 0.0, 1.0);
    const Real change = ratio - 1.0;
    const Real free = 1.0 + change * (1.0 - asked);
    const Real least = lanes.number(spline::kLeast), most = lanes.number(spline::kMost);
    const auto shorter = free<least, longer = free> most;
    const Real wanted = select(shorter, least, select(longer, most, free));
    const auto some = magnitude(change) > 1e-12;
    const Real found =
        generic::clamped((ratio - wanted) / select(some, change, Real(1.0)), 0.0, 1.0);
    const auto limited = (shorter | longer);
    return select(some, select(limited, found, asked), asked);
  }

  /// Gives the second of them.
  RIGC_INLINE static Real put_lengths(const Lanes& lanes, Real length, Real size) {
    const double* d = lanes.data();
    const auto sized = size > 1e-30;
    const Real own = select(sized, length / select(sized, size, Real(1.0)), Real(0.0));
    lanes.put(0, own);
    const double rest = d[spline::kLength];
    const Real ratio = rest > 1e-30 ? own * (1.0 / rest) : Real(1.0);
    lanes.put(1, ratio);
    return ratio;
  }

  /// Puts the outputs, each when the place of the next one is known.
  class Outputs {
   public:
    RIGC_INLINE Outputs(const Lanes& lanes, int controls, Real size, Real longer)
        : lanes_(lanes),
          rows_(lanes.data() + spline::kRows +
                static_cast<std::size_t>(controls) * spline::kControlRow),
          size_(size),
          longer_(longer),
          aims_(lanes.data()[spline::kAims] != 0),
          moves_(lanes.data()[spline::kMoves] != 0),
          twisted_(lanes.data()[spline::kTwisted] != 0) {}

    RIGC_INLINE const double* row(std::size_t k) const { return rows_ + k * spline::kOutputRow; }

    /// `beyond`: how far behind the curve's end. `keeps`: how much of its length at rest the bone
    /// from the output before keeps.
    RIGC_INLINE void add(std::size_t k, const spline_curve::Spot& spot, Real beyond, Real keeps) {
      using namespace spline_curve;
      const Vec3 along = unit(spot.slope, spot.axes.x);
      const Mat3 frame = frame_of(spot, along, twisted_);
      Vec3 at = spot.at + along * beyond + frame * (vec3_at(row(k) + kOffset) * size_);
      if (!aims_ && !moves_) {
        put(k, frame, at);
        return;
      }
      if (k > 0) {
        const Vec3 way = at - at_, own = at - free_;
        const Vec3 toward = unit(way, along_);
        const Real length = generic::length(own);
        free_ = at;
        const auto kept = keeps > 0.0;
        if (any(kept)) {
          // As long as at rest, times what the whole is longer where not all of it is kept.
          const Real wanted = row(k - 1)[kBone] * size_ * longer_;
          at = select(kept, at_ + toward * (length + (wanted - length) * keeps), at);
        }
        if (aims_) put(k - 1, frame_of(spot_, toward, twisted_), at_);
      }
      if (k == 0) free_ = at;
      if (aims_) spot_ = spot;
      at_ = at;
      along_ = along;
      frame_ = frame;
      if (!aims_) put(k, frame, at);
    }
    RIGC_INLINE void finish(std::size_t count) const {
      if (aims_) put(count - 1, frame_, at_);
    }

   private:
    RIGC_INLINE void put(std::size_t k, const Mat3& frame, const Vec3& at) const {
      const double* own = row(k) + spline::kTurned;
      const Mat3 m = frame * Mat3{vec3_at(own), vec3_at(own + 3), vec3_at(own + 6)};
      lanes_.put(spline::kFirstWorld + 12 * k, Affine{{m.x * size_, m.y * size_, m.z * size_}, at});
    }

    const Lanes& lanes_;
    const double* rows_;
    Real size_, longer_;
    bool aims_, moves_, twisted_;
    spline_curve::Spot spot_;  ///< of the output before
    Vec3 at_, along_;
    Vec3 free_;  ///< its place before lengths are kept
    Mat3 frame_;
  };
};

}  // namespace
}  // namespace rigc::eval
