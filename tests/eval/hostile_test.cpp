// SPDX-License-Identifier: MIT
// Every kernel of the table on hostile registers. Two laws. Kernels give finite numbers where
// bounds.h says so: registers hold finite numbers, because files and formulas with others are
// refused. And what a lane gives does not depend on what the other lanes hold, whatever they hold:
// so frames can be packed into blocks in any way.
#include <doctest/doctest.h>

#include <bit>

#include "eval/kernels/bounds.h"
#include "tests/eval/wild.h"

namespace rigc {
namespace {

using eval::Op;
using test::Arguments;
using test::Job;
using test::kSizes;
using test::Numbers;
using test::Random;
using test::Size;
using test::Wild;

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
      if (size > Size::in_range && eval::bound(op).finite != eval::Finite::always) return;
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
// would overflow. Columns below 1e-30 count as lost.
TEST_CASE("eval hostile: a parent scaled to nearly nothing") {
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
