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
  /// Of a matrix that is for certain a rotation times one positive factor (and an origin): that
  /// factor. 0 of anything else.
  double scale = 0;
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
  /// Definition::scale of a matrix that need not be the whole of its value.
  double scale(const Operand& matrix) const;

  const std::vector<Definition>& values() const { return values_; }

 private:
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
  double scale_of_newest() const;
  std::uint32_t hash_of(const Definition& definition) const;
  bool same(const Definition& a, const Definition& b) const;
  void grow();

  std::vector<Definition> values_;
  std::vector<Operand> arguments_;
  std::vector<double> data_;
  std::vector<Slot> index_;  // by what values are, to find equal ones
  std::size_t indexed_ = 0;
  std::vector<double> registers_;  // of folding
};

}  // namespace rigc::eval
