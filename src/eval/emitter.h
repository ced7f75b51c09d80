// SPDX-License-Identifier: MIT
// The values of a program that is being compiled: constants, inputs, and what instructions compute.
// Each is there once: equal constants and equal instructions (operation, operands, table) are one
// value. An instruction whose operands are all constant is run at once by its own kernel and
// becomes a constant. What nobody needs is left out by schedule.h, so rules may emit freely. Test:
// tests/eval/compile_test.cpp, tests/eval/emitter_test.cpp
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "eval/kernels/table.h"
#include "math/math.h"

namespace rigc::eval {

/// Numbers that the program knows or computes, or some neighbouring ones of them.
struct Operand {
  std::uint32_t value = 0;
  std::uint32_t offset = 0;
  std::uint32_t width = 0;
  bool operator==(const Operand&) const = default;
};

inline Operand slice(Operand whole, std::uint32_t offset, std::uint32_t width) {
  return {whole.value, whole.offset + offset, width};
}

/// A factor that is positive for certain: a number times powers of others that vary.
struct Factor {
  double number = 0;         ///< 0: nothing is known
  std::uint32_t powers = 0;  ///< which product of powers, as an Emitter counts them; 0: none vary
};

enum class Source : std::uint8_t { constant, input, computed };

/// Where a value comes from.
struct Definition {
  Source source = Source::constant;
  Op op{};                           ///< of a computed one
  std::uint32_t width = 0;           ///< numbers
  std::uint32_t first_argument = 0;  ///< of a computed one, among all arguments
  std::uint32_t argument_count = 0;
  std::uint32_t data = 0;  ///< among all data: the table; of a constant or input its numbers
  std::uint32_t data_count = 0;
  std::uint32_t node = 0;  ///< index of the scene node that it was first emitted for
  Factor factor;           ///< of a matrix that is for certain a rotation times it (and an origin)
};

class Emitter {
 public:
  Emitter() : index_(256) {}

  Operand constant(std::span<const double> numbers);
  Operand constant(std::initializer_list<double> numbers) {
    return constant(std::span(numbers.begin(), numbers.size()));
  }
  Operand constant_matrix(const math::Affine& matrix);
  /// Varies from frame to frame; holds `initial` until somebody sets it. Never one with another.
  Operand input(std::span<const double> initial);
  /// One instruction of `width` rows. `node` is the index of the scene node it is for.
  Operand emit(Op op, std::span<const Operand> arguments, std::span<const double> data,
               std::uint32_t width, std::uint32_t node);
  Operand emit(Op op, std::initializer_list<Operand> arguments, std::span<const double> data,
               std::uint32_t width, std::uint32_t node) {
    return emit(op, std::span(arguments.begin(), arguments.size()), data, width, node);
  }

  // What is known of an operand. References and spans are good until the next value is made.
  const Definition& definition(const Operand& operand) const { return values_[operand.value]; }
  std::span<const Operand> arguments(const Definition& definition) const;
  std::span<const double> data(const Definition& definition) const;
  bool is_constant(const Operand& operand) const {
    return values_[operand.value].source == Source::constant;
  }
  std::span<const double> numbers(const Operand& constant) const;
  math::Affine matrix(const Operand& constant) const;
  /// Definition::factor of a matrix that need not be the whole of its value.
  Factor factor(const Operand& matrix);
  /// The same where it is constant, else 0.
  double scale(const Operand& matrix);
  /// Of a vector whose components are one positive number: that number.
  Factor even_factor(const Operand& vector);
  Factor product(Factor a, Factor b);
  Factor inverse(Factor of);
  /// A known factor as a number.
  Operand number_of(Factor factor, std::uint32_t node);

  const std::vector<Definition>& values() const { return values_; }

 private:
  struct Power {
    Operand number;
    int exponent;
    bool operator==(const Power&) const = default;
  };
  using Powers = std::vector<Power>;  // in the order of their operands, none to the power 0

  std::uint32_t index_of(Powers powers);

  // A place of the index: open addressing, a power of two of them, at most half of them taken.
  struct Slot {
    std::uint32_t hash = 0;
    std::uint32_t value = UINT32_MAX;  // none
  };

  Operand whole(std::uint32_t value) const { return {value, 0, values_[value].width}; }
  /// The newest value, or the older one that equals it, which then replaces it.
  std::uint32_t unify();
  Operand fold(Op op, std::span<const Operand> arguments, std::span<const double> data,
               std::uint32_t width);
  Factor factor_of_newest();
  Factor number_factor(const Operand& number, int depth);
  std::uint32_t hash_of(const Definition& definition) const;
  bool same(const Definition& a, const Definition& b) const;
  void grow();

  std::vector<Definition> values_;
  std::vector<Operand> arguments_;
  std::vector<double> data_;
  std::vector<Slot> index_;  // by what values are, to find equal ones
  std::size_t indexed_ = 0;
  std::vector<Powers> powers_{{}};  // what Factor::powers counts
  std::vector<double> registers_;   // of folding
};

}  // namespace rigc::eval
