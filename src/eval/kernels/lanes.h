// SPDX-License-Identifier: MIT
// What kernels are written with: the lanes of a block, as many at once as the instruction set's
// registers hold. Included by kernels.cpp alone, which is compiled once for each instruction set:
// everything is in an unnamed namespace, so that no function of one instruction set can be taken
// for another's. Test: tests/eval/isa_test.cpp
#pragma once

#include "eval/kernels/table.h"
#include "math/generic/transforms.h"
#include "math/pack.h"

namespace rigc::eval {
namespace {

namespace generic = math::generic;
using math::any;
using math::magnitude;
using math::select;
using math::with_sign;

#if defined(RIGC_ONE_LANE)
using Real = double;
inline constexpr int kWidth = 1;
#elif defined(__AVX2__)
inline constexpr int kWidth = 4;
using Real = math::Pack<kWidth>;
#else
inline constexpr int kWidth = 2;
using Real = math::Pack<kWidth>;
#endif

using Mask = decltype(Real{} < Real{});
using Vec3 = math::Vec3Of<Real>;
using Quat = math::QuatOf<Real>;
using Mat3 = math::Mat3Of<Real>;
using Affine = math::AffineOf<Real>;
using Trs = math::TrsOf<Real>;

RIGC_INLINE Real load(const double* from) {
#if defined(RIGC_ONE_LANE)
  return *from;
#else
  return Real::load(from);
#endif
}
RIGC_INLINE void store(Real x, double* to) {
#if defined(RIGC_ONE_LANE)
  *to = x;
#else
  x.store(to);
#endif
}

/// Some neighbouring lanes of a call: arguments in, results out.
class Lanes {
 public:
  // Copied out of the call: what is written to registers could alias it.
  RIGC_INLINE Lanes(const Call& call, int first)
      : registers_(call.registers + first),
        arguments_(call.arguments),
        data_(call.data),
        out_(call.registers + static_cast<std::size_t>(call.out.row) * kLanes + first),
        count_(call.argument_count) {}

  RIGC_INLINE const double* data() const { return data_; }
  RIGC_INLINE std::size_t count() const { return count_; }
  RIGC_INLINE std::size_t width(std::size_t argument) const { return arguments_[argument].width; }

  RIGC_INLINE Real number(std::size_t argument, std::size_t row = 0) const {
    return load(registers_ + (arguments_[argument].row + row) * kLanes);
  }
  RIGC_INLINE Vec3 vec3(std::size_t argument, std::size_t row = 0) const {
    return {number(argument, row), number(argument, row + 1), number(argument, row + 2)};
  }
  RIGC_INLINE Quat quat(std::size_t argument) const {
    return {number(argument), number(argument, 1), number(argument, 2), number(argument, 3)};
  }
  RIGC_INLINE Affine affine(std::size_t argument) const {
    return {{vec3(argument), vec3(argument, 3), vec3(argument, 6)}, vec3(argument, 9)};
  }
  /// Where an affine map takes the origin.
  RIGC_INLINE Vec3 origin(std::size_t argument) const { return vec3(argument, 9); }

  RIGC_INLINE void put(std::size_t row, Real x) const { store(x, out_ + row * kLanes); }
  RIGC_INLINE void put(std::size_t row, const Vec3& v) const {
    put(row, v.x);
    put(row + 1, v.y);
    put(row + 2, v.z);
  }
  RIGC_INLINE void put(std::size_t row, const Quat& q) const {
    put(row, q.x);
    put(row + 1, q.y);
    put(row + 2, q.z);
    put(row + 3, q.w);
  }
  RIGC_INLINE void put(std::size_t row, const Affine& a) const {
    put(row, a.linear.x);
    put(row + 3, a.linear.y);
    put(row + 6, a.linear.z);
    put(row + 9, a.origin);
  }

 private:
  const double* registers_;
  const Register* arguments_;
  const double* data_;
  double* out_;
  std::size_t count_;
};

// Constants of a kernel's table.
RIGC_INLINE Vec3 vec3_at(const double* d) { return {Real(d[0]), Real(d[1]), Real(d[2])}; }
RIGC_INLINE Quat quat_at(const double* d) {
  return {Real(d[0]), Real(d[1]), Real(d[2]), Real(d[3])};
}
RIGC_INLINE Affine affine_at(const double* d) {
  return {{vec3_at(d), vec3_at(d + 3), vec3_at(d + 6)}, vec3_at(d + 9)};
}

/// Shorter than 1e-30: products with its inverse could overflow.
RIGC_INLINE Mask is_lost(const Vec3& column) { return dot(column, column) < 1e-60; }

/// From rig space into the space of `parent`; where the parent is flat, into that of its rotation
/// alone.
RIGC_INLINE Affine into(const Affine& parent) {
  Affine inverse = generic::inverse(parent);
  const Mat3& m = parent.linear;
  const auto singular = generic::is_zero(inverse.linear.x) & generic::is_zero(inverse.linear.y);
  const auto flat = singular | is_lost(m.x) | is_lost(m.y) | is_lost(m.z);
  if (any(flat)) {
    const Affine rotation{generic::orthonormal(parent.linear), parent.origin};
    const Affine rigid = generic::inverse(rotation);
    inverse.linear = select(flat, rigid.linear, inverse.linear);
    inverse.origin = select(flat, rigid.origin, inverse.origin);
  }
  return inverse;
}

/// How far the weights seen so far turn a mean toward the next item: weight / sum, 0 for no weight.
/// Weights below 0 count as 0. Where all are 0 all are equal.
class Mean {
 public:
  /// The weights are arguments `first`, `first` + 2 and so on.
  RIGC_INLINE Mean(const Lanes& lanes, std::size_t first, std::size_t count)
      : lanes_(lanes), first_(first) {
    for (std::size_t i = 0; i < count; ++i) total_ = total_ + positive(i);
  }
  RIGC_INLINE Real add(std::size_t i) {
    const Real weight = select(total_ > 0.0, positive(i), Real(1.0));
    const auto counts = weight > 0.0;
    sum_ = sum_ + weight;
    return select(counts, weight / select(counts, sum_, Real(1.0)), Real(0.0));
  }

 private:
  RIGC_INLINE Real positive(std::size_t i) const {
    const Real weight = lanes_.number(first_ + 2 * i);
    return select(weight > 0.0, weight, Real(0.0));
  }

  const Lanes& lanes_;
  std::size_t first_;
  Real total_{}, sum_{};
};

/// A kernel is a struct with a function `run` over some lanes; this is it over all of them.
template <class K>
void all_lanes(const Call& call) {
  for (int first = 0; first < kLanes; first += kWidth) K::run(Lanes(call, first));
}

}  // namespace
}  // namespace rigc::eval
