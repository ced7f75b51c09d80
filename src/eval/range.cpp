// SPDX-License-Identifier: MIT
// Arithmetic of ranges, as far as factors of modules need it. Test: tests/eval/range_test.cpp
#include "eval/range.h"

#include <algorithm>
#include <array>
#include <limits>

namespace rigc::eval {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr Range kAnything{-kInfinite, kInfinite};
// How many instructions back it is looked.
constexpr int kDeep = 12;

template <class F>
Range of_corners(Range a, Range b, const F& of) {
  const std::array<double, 4> corners{of(a.least, b.least), of(a.least, b.most),
                                      of(a.most, b.least), of(a.most, b.most)};
  if (std::ranges::any_of(corners, [](double x) { return x != x; })) return kAnything;
  return {std::ranges::min(corners), std::ranges::max(corners)};
}

bool is_bounded(Range a) { return a.least > -kInfinite && a.most < kInfinite; }

Range of_two(Op op, Range a, Range b) {
  switch (op) {
    case Op::add:
      return {a.least + b.least, a.most + b.most};
    case Op::subtract:
      return {a.least - b.most, a.most - b.least};
    case Op::min:
      return {std::min(a.least, b.least), std::min(a.most, b.most)};
    case Op::max:
      return {std::max(a.least, b.least), std::max(a.most, b.most)};
    case Op::multiply_numbers:
      return of_corners(a, b, [](double x, double y) { return x * y; });
    case Op::divide:
      if (!(b.least > 0)) return kAnything;
      return of_corners(a, b, [](double x, double y) { return x / y; });
    case Op::power:
      if (!(a.least > 0) || !is_bounded(a) || !is_bounded(b)) return kAnything;
      return of_corners(a, b, [](double x, double y) { return math::pow(x, y); });
    default:
      return kAnything;
  }
}

Range range(const Emitter& emitter, const Operand& number, int depth) {
  if (emitter.is_constant(number)) {
    const double n = emitter.numbers(number)[0];
    return {n, n};
  }
  const Definition& d = emitter.definition(number);
  if (d.source != Source::computed || d.width != 1 || depth == kDeep) return kAnything;
  const std::span<const Operand> a = emitter.arguments(d);
  const auto of = [&](std::size_t i) { return range(emitter, a[i], depth + 1); };
  if (d.op == Op::smoothstep) return {0, 1};
  if (d.op == Op::clamp) {
    const Range x = of(0), low = of(1), high = of(2);
    if (!(low.most <= high.least)) return kAnything;
    return {std::clamp(x.least, low.least, high.least), std::clamp(x.most, low.most, high.most)};
  }
  return a.size() == 2 && a[0].width == 1 && a[1].width == 1 ? of_two(d.op, of(0), of(1))
                                                             : kAnything;
}

}  // namespace

Range range_of(const Emitter& emitter, const Operand& number) { return range(emitter, number, 0); }

}  // namespace rigc::eval
