// SPDX-License-Identifier: MIT
// Every kernel of the table on hostile registers. Two laws. Kernels give finite numbers where
// bounds.h says so: registers hold finite numbers, because files and formulas with others are
// refused. And what a lane gives does not depend on what the other lanes hold, whatever they hold:
// so frames can be packed into blocks in any way.
#include <doctest/doctest.h>

#include <bit>
#include <limits>

#include "tests/eval/bounds.h"
#include "tests/eval/jobs.h"

namespace rigc {
namespace {

using eval::Op;
using test::Arguments;
using test::Job;
using test::Numbers;
using test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

// How wild numbers get: those of characters; from 2^-150 to 2^150; of any size; NaN and infinities
// too.
enum class Size { sane, in_range, extreme, broken };
constexpr Size kSizes[] = {Size::sane, Size::in_range, Size::extreme, Size::broken};

// Sizes of several kinds in one instruction, values that repeat, matrices that are singular.
class Wild : public test::Source {
 public:
  Wild(Random& random, Size size) : Source(random), size_(size) {}

  double number() override {
    Random& r = random();
    if (size_ == Size::broken && r.chance(25)) return r.chance(50) ? kNaN : sign() * kInfinity;
    if (size_ >= Size::extreme && r.chance(40)) {
      const double some[] = {1e300, kLargest, 1e160, 1e-160, 0x1p-1022, kDenormal};
      return sign() * some[r.below(std::size(some))];
    }
    if (size_ >= Size::in_range && r.chance(40)) return r.any_size(150, 0);
    const double some[] = {0.0, -0.0, 1, -1, 0.5, 2, 90, -180, 360, 1e-9, 1e6, 1e-30};
    return r.chance(50) ? some[r.below(std::size(some))] : r.between(-3, 3);
  }
  math::Quat rotation() override {
    Random& r = random();
    if (r.chance(20)) return before_ = -before_;
    if (r.chance(40)) return before_ = r.rotation();
    before_ = Source::rotation();
    // math::normalised of an infinite quaternion never returns.
    for (double* n : {&before_.x, &before_.y, &before_.z, &before_.w})
      if (std::isinf(*n)) *n = 0;
    return before_;
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
  double sign() { return random().chance(50) ? 1.0 : -1.0; }
  Size size_;
  math::Quat before_;
  math::Affine last_;
};

std::string text(const Numbers& numbers) {
  std::string out;
  char buffer[40];
  for (const double n : numbers) {
    std::snprintf(buffer, sizeof buffer, " %.17g", n);
    out += buffer;
  }
  return out;
}

std::string text(const Job& job, const Arguments& arguments) {
  std::string out = std::string(eval::row(job.op).name) + "\n data" + text(job.data);
  for (const scene::Value& value : arguments) out += "\n    " + text(eval::numbers_of(value));
  return out;
}

TEST_CASE("eval hostile: finite numbers give finite numbers") {
  for (const Size size : kSizes) {
    test::for_every_op([&](Op op) {
      if (size > Size::in_range && test::bound(op).finite != test::Finite::always) return;
      Random random(static_cast<std::uint64_t>(op) * 10 + static_cast<std::uint64_t>(size));
      Wild wild(random, size);
      int bad = 0;
      for (int i = 0; i < 1500; ++i) {
        const Job job = test::job_of(op, wild);
        std::vector<Arguments> lanes;
        for (int lane = 0; lane < eval::kLanes; ++lane) lanes.push_back(wild.arguments(job));
        const auto got = test::run_kernel(op, lanes, job.data, job.width);
        for (std::size_t lane = 0; lane < got.size(); ++lane) {
          if (!test::all_finite(got[lane]) && ++bad == 1)
            MESSAGE(text(job, lanes[lane]), "\n gives", text(got[lane]));
        }
      }
      CHECK_MESSAGE(bad == 0, eval::row(op).name, " at size ", static_cast<int>(size), ": ", bad);
    });
  }
}

// Bits, with every NaN the same: which of two NaN a sum hands on is the compiler's choice.
std::vector<std::uint64_t> bits_of(const Numbers& numbers) {
  std::vector<std::uint64_t> bits;
  for (const double n : numbers)
    bits.push_back(std::isnan(n) ? 0x7ff8000000000000u : std::bit_cast<std::uint64_t>(n));
  return bits;
}

TEST_CASE("eval hostile: a lane does not depend on what the other lanes hold") {
  for (const Size size : kSizes) {
    test::for_every_op([&](Op op) {
      CAPTURE(eval::row(op).name);
      Random random(static_cast<std::uint64_t>(op) * 10 + static_cast<std::uint64_t>(size) + 1000);
      Wild wild(random, size), broken(random, Size::broken);
      for (int i = 0; i < 150; ++i) {
        const Job job = test::job_of(op, wild);
        std::vector<Arguments> lanes;
        for (int lane = 0; lane < eval::kLanes; ++lane)
          lanes.push_back((lane % 3 == 2 ? broken : wild).arguments(job));
        const auto mixed = test::run_kernel(op, lanes, job.data, job.width);
        for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
          const std::vector<Arguments> same(eval::kLanes, lanes[lane]);
          for (const Numbers& alone : test::run_kernel(op, same, job.data, job.width)) {
            const bool equal = bits_of(alone) == bits_of(mixed[lane]);
            REQUIRE_MESSAGE(equal, text(job, lanes[lane]), "\n gives", text(alone), "\n and",
                            text(mixed[lane]));
          }
        }
      }
    });
  }
}

// The inverse of a parent that is scaled by 1e-300 has entries of 1e300: targets in its space
// overflow. Columns below 1e-30 should count as lost in eval::into, as in math::normalised.
TEST_CASE("eval hostile: a parent scaled to nearly nothing" * doctest::should_fail()) {
  const math::Affine parent = math::compose({{}, {}, {1e-300, 1e-300, 1e-300}});
  const math::Affine target = math::compose({{1e9, 0, 0}, {}, {1e9, 1e9, 1e9}});
  Numbers data{1, 0};
  test::append(data, math::Affine{});
  CHECK(test::all_finite(
      test::run_kernel(Op::constraint, std::vector<Arguments>(8, {parent, target, 1.0}), data, 10)
          .front()));
}

}  // namespace
}  // namespace rigc
