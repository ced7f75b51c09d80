// SPDX-License-Identifier: MIT
// What need not be computed is not emitted, and is worth what the kernel would have given.
#include "eval/simplify.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "tests/eval/jobs.h"

namespace rigc {
namespace {

using eval::Emitter;
using eval::Op;
using eval::Operand;

/// What an operand of an emitter holds, where its one input or constant is what it is.
struct Values {
  Emitter emitter;
  Operand x = emitter.input(std::array{1.5}), y = emitter.input(std::array{-2.0});
  Operand v = emitter.input(std::array{1.0, 2.0, 3.0}),
          w = emitter.input(std::array{3.0, 1.0, 0.5});
  Operand q = emitter.input(std::array{0.5, 0.5, -0.5, 0.5});
  Operand r = emitter.input(std::array{0.0, 0.6, 0.0, 0.8});
  Operand rigid = emitter.emit(Op::compose_rigid, {v, q}, {}, 12, 0);
  Operand zero = emitter.constant({0}), one = emitter.constant({1});
  Operand none = emitter.constant({0, 0, 0}), ones = emitter.constant({1, 1, 1});
  Operand no_turn = emitter.constant({0, 0, 0, 1});
  Operand still = emitter.constant_matrix({});

  Operand emit(Op op, std::initializer_list<Operand> arguments, std::uint32_t width) {
    return emitter.emit(op, arguments, {}, width, 0);
  }
  bool is_computed(const Operand& operand) const {
    return emitter.definition(operand).source == eval::Source::computed;
  }
};

TEST_CASE("eval simplify: numbers times 0 and 1, plus 0, choices that are made") {
  Values k;
  CHECK(k.emit(Op::multiply_numbers, {k.x, k.zero}, 1) == k.zero);
  CHECK(k.emit(Op::multiply_numbers, {k.one, k.x}, 1) == k.x);
  CHECK(k.emit(Op::add, {k.x, k.zero}, 1) == k.x);
  CHECK(k.emit(Op::add, {k.zero, k.x}, 1) == k.x);
  CHECK(k.emit(Op::subtract, {k.x, k.zero}, 1) == k.x);
  CHECK(k.emit(Op::subtract, {k.x, k.x}, 1) == k.zero);
  CHECK(k.is_computed(k.emit(Op::subtract, {k.zero, k.x}, 1)));
  CHECK(k.emit(Op::divide, {k.zero, k.x}, 1) == k.zero);
  CHECK(k.emit(Op::divide, {k.x, k.one}, 1) == k.x);
  CHECK(k.emit(Op::divide, {k.x, k.zero}, 1) == k.zero);
  CHECK(k.is_computed(k.emit(Op::divide, {k.one, k.x}, 1)));
  CHECK(k.emit(Op::power, {k.x, k.zero}, 1) == k.one);
  CHECK(k.emit(Op::power, {k.x, k.one}, 1) == k.x);
  CHECK(k.emit(Op::logical_and, {k.x, k.zero}, 1) == k.zero);
  CHECK(k.is_computed(k.emit(Op::logical_and, {k.x, k.one}, 1)));
  CHECK(k.emit(Op::select, {k.zero, k.x, k.y}, 1) == k.y);
  CHECK(k.emit(Op::select, {k.one, k.x, k.y}, 1) == k.x);
  CHECK(k.emit(Op::choose, {k.x, k.v, k.v}, 3) == k.v);
  CHECK(k.emit(Op::lerp, {k.x, k.y, k.zero}, 1) == k.x);
  CHECK(k.emit(Op::lerp, {k.x, k.y, k.one}, 1) == k.y);
  CHECK(k.is_computed(k.emit(Op::lerp, {k.zero, k.one, k.x}, 1)));
}

TEST_CASE("eval simplify: vectors, rotations and matrices") {
  Values k;
  CHECK(k.emit(Op::vector_add, {k.none, k.v}, 3) == k.v);
  CHECK(k.emit(Op::vector_subtract, {k.v, k.v}, 3) == k.none);
  CHECK(k.emit(Op::vector_scale, {k.v, k.zero}, 3) == k.none);
  CHECK(k.emit(Op::vector_scale, {k.v, k.one}, 3) == k.v);
  CHECK(k.is_computed(k.emit(Op::vector_scale, {k.ones, k.x}, 3)));
  CHECK(k.emit(Op::vector_multiply, {k.ones, k.v}, 3) == k.v);
  CHECK(k.emit(Op::vector_lerp, {k.v, k.w, k.one}, 3) == k.w);
  CHECK(k.emit(Op::dot, {k.v, k.none}, 1) == k.zero);
  CHECK(k.emit(Op::cross, {k.none, k.v}, 3) == k.none);
  CHECK(k.emit(Op::gather, {slice(k.v, 0, 1), slice(k.v, 1, 2)}, 3) == k.v);
  CHECK(k.is_computed(k.emit(Op::gather, {slice(k.v, 1, 2), slice(k.v, 0, 1)}, 3)));
  CHECK(k.emit(Op::axis_angle, {k.v, k.zero}, 4) == k.no_turn);
  CHECK(k.emit(Op::rotation_multiply, {k.no_turn, k.q}, 4) == k.q);
  CHECK(k.emit(Op::rotation_multiply, {k.q, k.no_turn}, 4) == k.q);
  const Operand back = k.emit(Op::rotation_inverse, {k.q}, 4);
  CHECK(k.emit(Op::rotation_multiply, {back, k.q}, 4) == k.no_turn);
  CHECK(k.emit(Op::rotation_multiply, {k.q, back}, 4) == k.no_turn);
  CHECK(k.is_computed(k.emit(Op::rotation_multiply, {k.r, back}, 4)));
  CHECK(k.emit(Op::rotation_apply, {k.no_turn, k.v}, 3) == k.v);
  CHECK(k.emit(Op::rotation_slerp, {k.q, k.r, k.zero}, 4) == k.q);
  CHECK(k.emit(Op::rotation_slerp, {k.q, k.r, k.one}, 4) == k.r);
  CHECK(k.emit(Op::multiply, {k.still, k.rigid}, 12) == k.rigid);
  CHECK(k.emit(Op::transform_point, {k.still, k.v}, 3) == k.v);
  CHECK(k.emit(Op::transform_point, {k.rigid, k.none}, 3) == slice(k.rigid, 9, 3));
  CHECK(k.emit(Op::transform_vector, {k.rigid, k.none}, 3) == k.none);
  CHECK(k.emit(Op::matrix_scale, {k.rigid}, 3) == k.ones);
  const Operand uneven = k.emit(Op::compose, {k.v, k.q, k.w}, 12);
  CHECK(k.is_computed(k.emit(Op::matrix_scale, {uneven}, 3)));
}

TEST_CASE("eval simplify: squares and roots are powers") {
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double x = random.between(-2, 2);
    for (const double exponent : {2.0, 0.5}) {
      Emitter emitter;
      const Operand in = emitter.input(std::array{x});
      const Operand out = emitter.emit(Op::power, {in, emitter.constant({exponent})}, {}, 1, 0);
      const Op op = emitter.definition(out).op;
      REQUIRE(op != Op::power);
      const auto count = static_cast<std::size_t>(eval::row(op).arguments);
      const double got = test::run_kernel_once(op, test::Arguments(count, x), {}, 1)[0];
      const double want = test::run_kernel_once(Op::power, {x, exponent}, {}, 1)[0];
      CHECK(got == doctest::Approx(want).epsilon(1e-15));
    }
  }
}

}  // namespace
}  // namespace rigc
