// SPDX-License-Identifier: MIT
// Hostile numbers for kernels. Test: tests/eval/hostile_test.cpp, tests/eval/digest_test.cpp
#pragma once

#include <limits>

#include "tests/eval/jobs.h"

namespace rigc::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kLargest = std::numeric_limits<double>::max();
inline constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

// How wild numbers get: those of characters; from 2^-150 to 2^150; of any size; NaN and infinities
// too.
enum class Size { sane, in_range, extreme, broken };
inline constexpr Size kSizes[] = {Size::sane, Size::in_range, Size::extreme, Size::broken};

// Sizes of several kinds in one instruction, values that repeat, matrices that are singular.
class Wild : public test::Source {
 public:
  Wild(Random& random, Size size) : Source(random), size_(size) {}

  double number() override {
    Random& r = random();
    const double sign = r.chance(50) ? 1.0 : -1.0;
    if (size_ == Size::broken && r.chance(25)) return r.chance(50) ? kNaN : sign * kInfinity;
    if (size_ >= Size::extreme && r.chance(40)) {
      const double some[] = {1e300, kLargest, 1e160, 1e-160, 0x1p-1022, kDenormal};
      return sign * some[r.below(std::size(some))];
    }
    if (size_ >= Size::in_range && r.chance(40)) return r.any_size(150, 0);
    const double some[] = {0.0, -0.0, 1, -1, 0.5, 2, 90, -180, 360, 1e-9, 1e6, 1e-30};
    return r.chance(50) ? some[r.below(std::size(some))] : r.between(-3, 3);
  }
  math::Quat rotation() override {
    Random& r = random();
    if (r.chance(20)) return before_ = -before_;
    if (r.chance(40)) return before_ = r.rotation();
    return before_ = Source::rotation();
  }
  math::Affine matrix() override {
    Random& r = random();
    if (r.chance(20)) return last_;
    last_ = r.chance(50) ? Source::matrix() : math::compose(r.trs(false));
    if (r.chance(15)) last_.linear.y = last_.linear.x;
    if (r.chance(15)) last_.linear.z = -last_.linear.z;
    if (r.chance(15)) last_.linear.x = {};
    if (r.chance(15)) last_.linear.y = last_.linear.x * 0.7 + last_.linear.z * 0.2;
    if (r.chance(10)) last_.linear = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    return last_;
  }

 private:
  Size size_;
  math::Quat before_;
  math::Affine last_;
};

}  // namespace rigc::test
