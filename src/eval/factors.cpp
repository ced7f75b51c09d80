// SPDX-License-Identifier: MIT
// What an Emitter knows of matrices: which are a rotation times one positive factor, and which
// factor. One that varies is known by what it is a product of, so that a size and its inverse
// give 1. Test: tests/eval/emitter_test.cpp
#include <algorithm>
#include <cmath>

#include "eval/emitter.h"
#include "eval/range.h"
#include "eval/similarity.h"
#include "eval/values.h"

namespace rigc::eval {

namespace {

// The data of what computes its own axes: where they lie in it is in kernels/table.h.
constexpr std::size_t kAimWorldLinear = 2;
// Numbers that vary count as factors between these.
constexpr double kLeastVarying = 1e-6, kMostVarying = 1e6;
// How many instructions back a product is taken apart.
constexpr int kDeep = 8;
// Components that differ by less are one factor, as in uniform_scale().
constexpr double kSame = 1e-12;

double even_scale(std::span<const double> xyz) {
  const double s = xyz[0];
  const bool even = std::fabs(xyz[1] - s) <= kSame * s && std::fabs(xyz[2] - s) <= kSame * s;
  if (!(s > 0) || !even) return 0;
  return std::fabs(s - 1) <= kSame ? 1 : s;
}

}  // namespace

std::uint32_t Emitter::index_of(Powers powers) {
  std::erase_if(powers, [](const Power& power) { return power.exponent == 0; });
  const auto found = std::ranges::find(powers_, powers);
  if (found == powers_.end()) {
    powers_.push_back(std::move(powers));
    return static_cast<std::uint32_t>(powers_.size() - 1);
  }
  return static_cast<std::uint32_t>(found - powers_.begin());
}

Factor Emitter::product(Factor a, Factor b) {
  const double number = a.number * b.number;
  if (number == 0 || b.powers == 0) return {number, number == 0 ? 0 : a.powers};
  if (a.powers == 0) return {number, b.powers};
  Powers all = powers_[a.powers];
  for (const Power& power : powers_[b.powers]) {
    const auto before = [](const Power& x, const Power& y) {
      return x.number.value != y.number.value ? x.number.value < y.number.value
                                              : x.number.offset < y.number.offset;
    };
    const auto at = std::lower_bound(all.begin(), all.end(), power, before);
    if (at != all.end() && at->number == power.number) {
      at->exponent += power.exponent;
    } else {
      all.insert(at, power);
    }
  }
  return {number, index_of(std::move(all))};
}

Factor Emitter::inverse(Factor of) {
  if (of.number == 0) return {};
  Powers powers = powers_[of.powers];
  for (Power& power : powers) power.exponent = -power.exponent;
  return {1 / of.number, index_of(std::move(powers))};
}

Factor Emitter::number_factor(const Operand& number, int depth) {
  if (is_constant(number)) {
    const double n = numbers(number)[0];
    return {n >= kLeastScale && n <= kMostScale ? n : 0, 0};
  }
  const Definition d = definition(number);
  if (d.source == Source::computed && d.width == 1 && depth < kDeep) {
    const Operand a = arguments(d)[0], b = d.argument_count == 2 ? arguments(d)[1] : a;
    Factor factor;
    if (d.op == Op::multiply_numbers)
      factor = product(number_factor(a, depth + 1), number_factor(b, depth + 1));
    if (d.op == Op::divide)
      factor = product(number_factor(a, depth + 1), inverse(number_factor(b, depth + 1)));
    if (factor.number != 0) return factor;
  }
  const Range range = range_of(*this, number);
  if (!(range.least >= kLeastVarying && range.most <= kMostVarying)) return {};
  return {1, index_of({{number, 1}})};
}

Factor Emitter::even_factor(const Operand& vector) {
  if (is_constant(vector)) return {even_scale(numbers(vector)), 0};
  const Definition d = definition(vector);
  if (d.source != Source::computed || d.op != Op::gather || d.argument_count != 3) return {};
  if (vector.offset != 0 || d.width != 3) return {};
  const std::span<const Operand> a = arguments(d);
  if (a[0] != a[1] || a[1] != a[2]) return {};
  return number_factor(Operand(a[0]), 0);
}

Operand Emitter::number_of(Factor factor, std::uint32_t node) {
  Operand product = constant({factor.number});
  const Powers powers = powers_[factor.powers];
  for (const Power& power : powers) {
    const Op op = power.exponent > 0 ? Op::multiply_numbers : Op::divide;
    for (int i = 0; i < std::abs(power.exponent); ++i)
      product = emit(op, {product, power.number}, {}, 1, node);
  }
  return product;
}

Factor Emitter::factor_of_newest() {
  const Definition d = values_.back();
  const auto argument = [&](std::size_t i) { return arguments(d)[i]; };
  const auto with = [](double number) { return Factor{number, 0}; };
  switch (d.op) {
    case Op::compose_rigid:
    case Op::compose_under:
    case Op::blend:
      return with(1);
    case Op::compose:
      return even_factor(argument(2));
    case Op::multiply:
      return product(factor(argument(0)), factor(argument(1)));
    case Op::hang:
      return product(factor(argument(1)), with(uniform_scale(mat3_from(data(d).data()))));
    case Op::hang_straight:
    case Op::place:
      return factor(argument(1));
    case Op::gather: {  // of the axes of another
      const Operand axes = argument(0);
      if (d.width != 12 || d.argument_count != 2 || axes.width != 9) return {};
      return factor({axes.value, axes.offset, 12});
    }
    case Op::matrix_inverse:
      return inverse(factor(argument(0)));
    case Op::aim_world:
      return with(uniform_scale(mat3_from(data(d).data() + kAimWorldLinear)));
    default:
      return {};
  }
}

Factor Emitter::factor(const Operand& operand) {
  if (operand.width != 12) return {};
  if (is_constant(operand)) return {uniform_scale(matrix(operand).linear), 0};
  const Definition d = definition(operand);
  if (d.source != Source::computed) return {};
  if (d.op == Op::spline) return factor(Operand(arguments(d)[0]));  // its outputs have the base's
  if (d.op != Op::ik_two_bone) return operand.offset == 0 && d.width == 12 ? d.factor : Factor{};
  // The worlds of start and middle: scaled as base, start and, of the second, middle.
  Factor found = factor(Operand(arguments(d)[0]));
  for (std::size_t i = 0; i <= operand.offset / 12; ++i)
    found = product(found, even_factor(Operand(arguments(d)[7 + i])));
  return found;
}

double Emitter::scale(const Operand& operand) {
  const Factor found = factor(operand);
  return found.powers == 0 ? found.number : 0;
}

}  // namespace rigc::eval
