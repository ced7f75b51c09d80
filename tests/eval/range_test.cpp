// SPDX-License-Identifier: MIT
// Ranges hold what kernels give, whatever goes in.
#include "eval/range.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "tests/eval/jobs.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using eval::Emitter;
using eval::Op;
using eval::Operand;
using eval::Range;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST_CASE("eval range: of what") {
  Emitter e;
  const Operand x = e.input(std::array{0.0}), one = e.constant({1});
  const auto emit = [&](Op op, std::initializer_list<Operand> a) {
    return e.emit(op, a, {}, 1, 0);
  };
  const auto check = [&](const Operand& of, double least, double most) {
    const Range found = eval::range_of(e, of);
    CHECK(found.least == doctest::Approx(least));
    CHECK(found.most == doctest::Approx(most));
  };
  const auto check_unknown = [&](const Operand& of) {
    const Range found = eval::range_of(e, of);
    CHECK((found.least == -kInfinite && found.most == kInfinite));
  };
  check(one, 1, 1);
  check_unknown(x);
  const Operand some = emit(Op::clamp, {x, e.constant({0.2}), e.constant({5})});
  check(some, 0.2, 5);
  check_unknown(emit(Op::clamp, {x, e.constant({5}), e.constant({0.2})}));
  check_unknown(emit(Op::clamp, {some, x, one}));
  CHECK(eval::range_of(e, emit(Op::max, {x, one})).least == 1);
  CHECK(eval::range_of(e, emit(Op::max, {x, one})).most == kInfinite);
  check(emit(Op::min, {some, one}), 0.2, 1);
  check(emit(Op::add, {some, one}), 1.2, 6);
  check(emit(Op::subtract, {one, some}), -4, 0.8);
  check(emit(Op::multiply_numbers, {some, e.constant({-2})}), -10, -0.4);
  check(emit(Op::divide, {one, some}), 0.2, 5);
  check_unknown(emit(Op::divide, {one, x}));
  check(emit(Op::power, {some, e.constant({-0.5})}), std::sqrt(0.2), std::sqrt(5));
  check_unknown(emit(Op::power, {some, x}));
  check_unknown(emit(Op::power, {emit(Op::subtract, {some, one}), e.constant({3})}));
  check(emit(Op::smoothstep, {x, one, some}), 0, 1);
}

TEST_CASE("eval range: programs stay in it") {
  test::Random random(1);
  for (int i = 0; i < 500; ++i) {
    Emitter e;
    std::vector<Operand> known;
    std::vector<double> worth;  // with the inputs drawn
    for (int k = 0; k < 3; ++k) {
      worth.push_back(random.between(-3, 3));
      known.push_back(e.input(std::array{worth.back()}));
      worth.push_back(random.between(-3, 3));
      known.push_back(e.constant({worth.back()}));
    }
    for (int k = 0; k < 12; ++k) {
      constexpr Op kOps[] = {Op::add,    Op::subtract, Op::multiply_numbers,
                             Op::divide, Op::power,    Op::min,
                             Op::max,    Op::clamp,    Op::smoothstep};
      const Op op = kOps[random.below(std::size(kOps))];
      std::vector<Operand> arguments;
      test::Arguments numbers;
      for (int a = 0; a < eval::row(op).arguments; ++a) {
        const std::size_t from = random.below(known.size());
        arguments.push_back(known[from]);
        numbers.push_back(worth[from]);
      }
      const Operand made = e.emit(op, arguments, {}, 1, 0);
      const double got = test::run_kernel_once(op, numbers, {}, 1)[0];
      const Range found = eval::range_of(e, made);
      const double room = 1e-12 * (1 + std::fabs(got));
      CHECK((found.least <= got + room && got <= found.most + room));
      known.push_back(made);
      worth.push_back(got);
    }
  }
}

}  // namespace
}  // namespace rigc
