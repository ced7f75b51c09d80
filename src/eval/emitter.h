// SPDX-License-Identifier: MIT
// Emits instructions in the order asked for. An instruction whose arguments are all constant is run
// at once by its own kernel and becomes a constant. Rows are given out at the end, to what is used.
// Test: tests/eval/compile_test.cpp
#pragma once

#include <cstdint>
#include <vector>

#include "eval/kernels/table.h"
#include "eval/program.h"

namespace rigc::eval {

/// Numbers that the program knows or computes, or some neighbouring ones of them.
struct Operand {
  std::uint32_t value = 0;
  std::uint32_t offset = 0;
  std::uint32_t width = 0;
};

inline Operand slice(Operand whole, std::uint32_t offset, std::uint32_t width) {
  return {whole.value, whole.offset + offset, width};
}

class Emitter {
 public:
  Operand constant(std::vector<double> numbers);
  /// Varies from frame to frame; holds `initial` until somebody sets it.
  Operand input(std::vector<double> initial);
  /// One instruction of `width` rows. `node` is the index of the scene node it is for.
  Operand emit(Op op, const std::vector<Operand>& arguments, const std::vector<double>& data,
               std::uint32_t width, std::uint32_t node);
  Program finish(const std::vector<Operand>& inputs, const std::vector<Operand>& outputs) const;

 private:
  enum class Source : std::uint8_t { constant, input, computed };
  struct Value {
    Source source;
    std::uint32_t width;
    std::vector<double> numbers;  // of constants and inputs
  };
  struct Pending {
    Op op;
    std::uint32_t value;  // what it computes
    std::size_t first_argument;
    std::uint32_t argument_count;
    std::size_t data;
    std::uint32_t node;
  };
  class Rows;

  bool all_constant(const std::vector<Operand>& operands) const;
  std::vector<double> fold(Op op, const std::vector<Operand>& arguments,
                           const std::vector<double>& data, std::uint32_t width) const;

  std::vector<Value> values_;
  std::vector<Pending> pending_;
  std::vector<Operand> arguments_;
  std::vector<double> data_;
};

}  // namespace rigc::eval
