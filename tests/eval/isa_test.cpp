// SPDX-License-Identifier: MIT
// Every instruction set gives the bits of a kernel that computes one lane at a time, whatever
// stands in the other lanes.
#include "eval/isa.h"

#include <doctest/doctest.h>

#include <cstring>

#include "tests/eval/wild.h"

namespace rigc::eval::scalar {
const KernelRow* kernels();  // kernels.cpp compiled for one lane, see tests/CMakeLists.txt
}

namespace rigc {
namespace {

using eval::Isa;
using eval::Op;
using test::Numbers;
using test::Size;

TEST_CASE("eval isa: names") {
  CHECK(eval::name(Isa::baseline) == "baseline");
  CHECK(eval::name(Isa::avx2) == "avx2");
  CHECK(eval::find_isa("baseline") == Isa::baseline);
  CHECK(!eval::find_isa("sse9"));
  CHECK(!eval::find_isa(""));
  for (const Isa isa : eval::available_isas()) CHECK(eval::find_isa(eval::name(isa)) == isa);
}

// Bits, but one NaN is another.
bool same(const std::vector<Numbers>& a, const std::vector<Numbers>& b) {
  for (std::size_t lane = 0; lane < a.size(); ++lane) {
    for (std::size_t i = 0; i < a[lane].size(); ++i) {
      const double x = a[lane][i], y = b[lane][i];
      if (x != x && y != y) continue;
      if (std::memcmp(&x, &y, sizeof(double)) != 0) return false;
    }
  }
  return true;
}

TEST_CASE("eval isa: the same bits for every instruction set and lane width") {
  test::for_every_op([](Op op) {
    CAPTURE(eval::row(op).name);
    const eval::Kernel scalar = eval::scalar::kernels()[static_cast<std::size_t>(op)].kernel;
    for (const Size size : {Size::sane, Size::in_range, Size::broken}) {
      test::Random random(static_cast<std::uint64_t>(op) + 1);
      test::Wild wild(random, size);
      for (int i = 0; i < 150; ++i) {
        const test::Job job = test::job_of(op, wild);
        std::vector<test::Arguments> lanes;
        for (int lane = 0; lane < eval::kLanes; ++lane) lanes.push_back(wild.arguments(job));
        const auto want = test::run_kernel(scalar, lanes, job.data, job.width);
        for (const Isa isa : eval::available_isas()) {
          CAPTURE(eval::name(isa));
          const eval::Kernel kernel = eval::row(op, isa).kernel;
          CHECK(same(test::run_kernel(kernel, lanes, job.data, job.width), want));
        }
      }
    }
  });
}

}  // namespace
}  // namespace rigc
