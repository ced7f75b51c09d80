// SPDX-License-Identifier: MIT
// Values are there once, constants are folded, and scales of matrices are known where they can be.
#include "eval/emitter.h"

#include <doctest/doctest.h>

#include <array>

#include "tests/math/random.h"

namespace rigc {
namespace {

using eval::Emitter;
using eval::Op;
using eval::Operand;

TEST_CASE("eval emitter: equal constants and instructions are one value, inputs never") {
  Emitter emitter;
  const Operand a = emitter.input(std::array{1.0}), b = emitter.input(std::array{1.0});
  CHECK(a != b);
  CHECK(emitter.constant({1, 2}) == emitter.constant({1, 2}));
  CHECK(emitter.constant({1, 2}) != emitter.constant({1, 3}));
  CHECK(emitter.constant({0.0}) != emitter.constant({-0.0}));
  const Operand sum = emitter.emit(Op::add, {a, b}, {}, 1, 0);
  const std::size_t values = emitter.values().size();
  CHECK(emitter.emit(Op::add, {a, b}, {}, 1, 7) == sum);
  CHECK(emitter.values().size() == values);
  CHECK(emitter.emit(Op::add, {b, a}, {}, 1, 0) != sum);
  CHECK(emitter.emit(Op::subtract, {a, b}, {}, 1, 0) != sum);
}

TEST_CASE("eval emitter: what is constant is computed at once") {
  Emitter emitter;
  const Operand three =
      emitter.emit(Op::add, {emitter.constant({1}), emitter.constant({2})}, {}, 1, 0);
  REQUIRE(emitter.is_constant(three));
  CHECK(emitter.numbers(three)[0] == 3);
  CHECK(three == emitter.constant({3}));
}

struct Matrices {
  Emitter emitter;
  Operand t = emitter.input(std::array{0.0, 0.0, 0.0});
  Operand q = emitter.input(std::array{0.0, 0.0, 0.0, 1.0});
  Operand s = emitter.input(std::array{1.0, 1.0, 1.0});

  Operand scaled(const Operand& by) { return emitter.emit(Op::compose, {t, q, by}, {}, 12, 0); }
};

TEST_CASE("eval emitter: scales of matrices") {
  Matrices m;
  Emitter& e = m.emitter;
  const Operand rigid = e.emit(Op::compose_rigid, {m.t, m.q}, {}, 12, 0);
  CHECK(e.scale(rigid) == 1);
  CHECK(e.scale(m.scaled(m.s)) == 0);
  CHECK(e.scale(m.scaled(e.constant({2, 2, 2}))) == 2);
  CHECK(e.scale(m.scaled(e.constant({2, 2, 3}))) == 0);
  CHECK(e.scale(m.scaled(e.constant({-2, -2, -2}))) == 0);
  CHECK(e.scale(m.scaled(e.constant({0, 0, 0}))) == 0);
  const Operand twice = m.scaled(e.constant({2, 2, 2}));
  CHECK(e.scale(e.emit(Op::multiply, {twice, twice}, {}, 12, 0)) == 4);
  CHECK(e.scale(e.emit(Op::multiply, {twice, m.scaled(m.s)}, {}, 12, 0)) == 0);
  CHECK(e.scale(e.emit(Op::place, {m.scaled(m.s), twice, m.t}, {}, 12, 0)) == 2);
  const std::array<double, 12> half{0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.5, 1, 2, 3};
  const std::array<double, 12> flat{0.5, 0, 0, 0, 0.5, 0, 0, 0, 0, 1, 2, 3};
  CHECK(e.scale(e.emit(Op::hang, {rigid, twice}, half, 12, 0)) == 1);
  CHECK(e.scale(e.emit(Op::hang, {rigid, twice}, flat, 12, 0)) == 0);
  // Past what products of scales may come to nothing is known.
  Operand large = m.scaled(e.constant({1e20, 1e20, 1e20}));
  CHECK(e.scale(large) == 1e20);
  CHECK(e.scale(e.emit(Op::multiply, {large, large}, {}, 12, 0)) == 0);
}

TEST_CASE("eval emitter: scales that vary are known by their product") {
  Matrices m;
  Emitter& e = m.emitter;
  const Operand any = e.input(std::array{1.0});
  const Operand size = e.emit(Op::clamp, {any, e.constant({0.5}), e.constant({2})}, {}, 1, 0);
  const Operand back = e.emit(Op::divide, {e.constant({3}), size}, {}, 1, 0);
  const auto even = [&](const Operand& n) { return e.emit(Op::gather, {n, n, n}, {}, 3, 0); };
  const Operand larger = m.scaled(even(size)), smaller = m.scaled(even(back));
  CHECK(e.factor(larger).number == 1);
  CHECK(e.factor(larger).powers != 0);
  CHECK(e.scale(larger) == 0);
  CHECK(e.scale(e.emit(Op::multiply, {larger, smaller}, {}, 12, 0)) == 3);
  CHECK(e.number_of(e.factor(larger), 0) == size);
  const Operand twice = e.emit(Op::multiply, {larger, larger}, {}, 12, 0);
  CHECK(e.factor(twice).powers != e.factor(larger).powers);
  CHECK(e.scale(e.emit(Op::multiply, {twice, e.emit(Op::matrix_inverse, {twice}, {}, 12, 0)}, {},
                       12, 0)) == 1);
  // What may be 0 or below is no factor, nor is what differs along the axes.
  CHECK(e.factor(m.scaled(even(any))).number == 0);
  const Operand uneven = e.emit(Op::gather, {size, size, back}, {}, 3, 0);
  CHECK(e.factor(m.scaled(uneven)).number == 0);
}

TEST_CASE("eval emitter: scales of solved limbs") {
  Matrices m;
  Emitter& e = m.emitter;
  const auto solve = [&](const Operand& base, const Operand& start, const Operand& middle) {
    const Operand at = e.constant({0, 1, 0}), twist = e.constant({0});
    const std::array<double, 14> data{0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    return e.emit(Op::ik_two_bone, {base, base, base, twist, at, at, at, start, middle}, data, 24,
                  0);
  };
  const Operand base = m.scaled(e.constant({2, 2, 2}));
  const Operand worlds = solve(base, e.constant({3, 3, 3}), e.constant({5, 5, 5}));
  CHECK(e.scale(slice(worlds, 0, 12)) == 6);
  CHECK(e.scale(slice(worlds, 12, 12)) == 30);
  const Operand moving = solve(base, e.constant({3, 3, 3}), m.s);
  CHECK(e.scale(slice(moving, 0, 12)) == 6);
  CHECK(e.scale(slice(moving, 12, 12)) == 0);
  CHECK(e.scale(slice(solve(m.scaled(m.s), e.constant({1, 1, 1}), m.s), 0, 12)) == 0);
}

}  // namespace
}  // namespace rigc
