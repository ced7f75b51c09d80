// SPDX-License-Identifier: MIT
// Rules of what need not be computed. Test: tests/eval/simplify_test.cpp
#include "eval/simplify.h"

#include <algorithm>
#include <array>

namespace rigc::eval {

namespace {

class Simplifier {
 public:
  Simplifier(Emitter& emitter, std::span<const Operand> arguments, std::uint32_t node)
      : emitter_(emitter), arguments_(arguments.begin(), arguments.end()), node_(node) {}

  std::optional<Operand> apply(Op op) {
    if (auto found = of_numbers(op)) return found;
    if (auto found = of_vectors(op)) return found;
    if (auto found = of_rotations(op)) return found;
    return of_matrices(op);
  }

 private:
  const Operand& at(std::size_t i) const { return arguments_[i]; }

  bool all_are(const Operand& operand, double number) const {
    if (!emitter_.is_constant(operand)) return false;
    return std::ranges::all_of(emitter_.numbers(operand), [&](double n) { return n == number; });
  }
  bool is(std::size_t i, double number) const { return all_are(at(i), number); }

  bool is_no_turn(std::size_t i) const {
    if (!emitter_.is_constant(at(i))) return false;
    const auto q = emitter_.numbers(at(i));
    return q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] != 0;
  }
  bool is_identity(std::size_t i) const {
    return emitter_.is_constant(at(i)) && emitter_.matrix(at(i)) == math::Affine{};
  }

  Operand zeros(std::size_t count) { return emitter_.constant(std::vector<double>(count)); }
  Operand no_turn() { return emitter_.constant({0, 0, 0, 1}); }

  std::optional<Operand> of_numbers(Op op) {
    switch (op) {
      case Op::add:
        return sum();
      case Op::subtract:
        return difference();
      case Op::multiply_numbers:
        return product();
      case Op::divide:
        if (is(0, 0) || is(1, 0)) return zeros(1);
        if (is(1, 1)) return at(0);
        return std::nullopt;
      case Op::power:
        if (is(1, 0) || is(0, 1)) return emitter_.constant({1});
        if (is(1, 1)) return at(0);
        if (is(1, 2)) return emitter_.emit(Op::multiply_numbers, {at(0), at(0)}, {}, 1, node_);
        if (is(1, 0.5)) return emitter_.emit(Op::sqrt, {at(0)}, {}, 1, node_);
        return std::nullopt;
      case Op::logical_and:
        if (is(0, 0) || is(1, 0)) return zeros(1);
        return std::nullopt;
      case Op::select:
      case Op::choose:
        return choice();
      case Op::lerp:
      case Op::vector_lerp:
        return between();
      default:
        return std::nullopt;
    }
  }

  std::optional<Operand> of_vectors(Op op) {
    switch (op) {
      case Op::vector_add:
        return sum();
      case Op::vector_subtract:
        return difference();
      case Op::vector_scale:
      case Op::vector_multiply:
        if (is(0, 0) || is(1, 0)) return zeros(3);
        if (is(1, 1)) return at(0);
        if (is(0, 1) && op == Op::vector_multiply) return at(1);
        return std::nullopt;
      case Op::dot:
        if (is(0, 0) || is(1, 0)) return zeros(1);
        return std::nullopt;
      case Op::cross:
        if (is(0, 0) || is(1, 0)) return zeros(3);
        return std::nullopt;
      case Op::gather:
        return neighbours();
      default:
        return std::nullopt;
    }
  }

  std::optional<Operand> of_rotations(Op op) {
    switch (op) {
      case Op::axis_angle:
        if (is(0, 0) || is(1, 0)) return no_turn();
        return std::nullopt;
      case Op::rotation_multiply:
        if (is_no_turn(0)) return at(1);
        if (is_no_turn(1)) return at(0);
        if (is_inverse_of(0, 1) || is_inverse_of(1, 0)) return no_turn();
        return std::nullopt;
      case Op::rotation_apply:
        if (is_no_turn(0) || is(1, 0)) return at(1);
        return std::nullopt;
      case Op::rotation_slerp:
        return between();
      default:
        return std::nullopt;
    }
  }

  std::optional<Operand> of_matrices(Op op) {
    switch (op) {
      case Op::multiply:
        if (is_identity(0)) return at(1);
        if (is_identity(1)) return at(0);
        return std::nullopt;
      case Op::transform_point:
        if (is_identity(0)) return at(1);
        if (is(1, 0)) return slice(at(0), 9, 3);
        return std::nullopt;
      case Op::transform_vector:
        if (is_identity(0) || is(1, 0)) return at(1);
        return std::nullopt;
      case Op::matrix_scale:
        if (const double scale = emitter_.scale(at(0)); scale != 0)
          return emitter_.constant({scale, scale, scale});
        return std::nullopt;
      default:
        return std::nullopt;
    }
  }

  std::optional<Operand> sum() const {
    if (is(0, 0)) return at(1);
    if (is(1, 0)) return at(0);
    return std::nullopt;
  }
  std::optional<Operand> difference() {
    if (is(1, 0)) return at(0);
    if (at(0) == at(1)) return zeros(at(0).width);
    return std::nullopt;
  }
  std::optional<Operand> product() {
    if (is(0, 0) || is(1, 0)) return zeros(1);
    if (is(0, 1)) return at(1);
    if (is(1, 1)) return at(0);
    return std::nullopt;
  }
  std::optional<Operand> choice() const {
    if (at(1) == at(2)) return at(1);
    if (emitter_.is_constant(at(0))) return is(0, 0) ? at(2) : at(1);
    return std::nullopt;
  }
  // Part of the way from one to another.
  std::optional<Operand> between() const {
    if (is(2, 0) || at(0) == at(1)) return at(0);
    if (is(2, 1)) return at(1);
    return std::nullopt;
  }

  bool is_inverse_of(std::size_t inverse, std::size_t of) const {
    const Definition& d = emitter_.definition(at(inverse));
    return d.source == Source::computed && d.op == Op::rotation_inverse &&
           emitter_.arguments(d)[0] == at(of);
  }

  // What lies side by side already need not be gathered.
  std::optional<Operand> neighbours() const {
    Operand all = at(0);
    for (std::size_t i = 1; i < arguments_.size(); ++i) {
      if (at(i) != Operand{all.value, all.offset + all.width, at(i).width}) return std::nullopt;
      all.width += at(i).width;
    }
    return all;
  }

  Emitter& emitter_;
  std::vector<Operand> arguments_;  // a copy: new constants may move what they were given as
  std::uint32_t node_;
};

// Operations that no rule is for, which are most of a large rig's: they shall cost nothing.
bool has_rules(Op op) {
  switch (op) {
    case Op::multiply:
    case Op::gather:
    case Op::vector_add:
    case Op::vector_subtract:
    case Op::vector_scale:
    case Op::vector_multiply:
    case Op::vector_lerp:
    case Op::dot:
    case Op::cross:
    case Op::rotation_multiply:
    case Op::rotation_apply:
    case Op::rotation_slerp:
    case Op::axis_angle:
    case Op::matrix_scale:
    case Op::transform_point:
    case Op::transform_vector:
    case Op::choose:
    case Op::add:
    case Op::subtract:
    case Op::multiply_numbers:
    case Op::divide:
    case Op::power:
    case Op::logical_and:
    case Op::select:
    case Op::lerp:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::optional<Operand> simplified(Emitter& emitter, Op op, std::span<const Operand> arguments,
                                  std::uint32_t node) {
  if (!has_rules(op)) return std::nullopt;
  return Simplifier(emitter, arguments, node).apply(op);
}

}  // namespace rigc::eval
