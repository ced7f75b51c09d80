// SPDX-License-Identifier: MIT
// Emitting, folding and the giving out of rows. Test: tests/eval/compile_test.cpp
#include "eval/emitter.h"

#include <bit>
#include <cassert>
#include <map>
#include <utility>

namespace rigc::eval {

namespace {

constexpr std::uint32_t kNoRow = UINT32_MAX;

// Bits, so that 0 and -0 stay apart.
std::vector<std::uint64_t> bits_of(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> bits;
  bits.reserve(numbers.size());
  for (const double n : numbers) bits.push_back(std::bit_cast<std::uint64_t>(n));
  return bits;
}

}  // namespace

// Rows of values; equal constants share theirs.
class Emitter::Rows {
 public:
  Rows(const std::vector<Value>& values, Program& program)
      : values_(values), program_(program), rows_(values.size(), kNoRow) {}

  Register of(const Operand& operand) {
    std::uint32_t& row = rows_[operand.value];
    if (row == kNoRow) row = place(values_[operand.value]);
    return {row + operand.offset, operand.width};
  }

 private:
  std::uint32_t place(const Value& value) {
    if (value.source == Source::constant) {
      const auto found = constants_.try_emplace(bits_of(value.numbers), program_.rows);
      if (!found.second) return found.first->second;
    }
    const std::uint32_t row = program_.rows;
    program_.rows += value.width;
    for (std::size_t i = 0; i < value.numbers.size(); ++i) {
      program_.constants.push_back({row + static_cast<std::uint32_t>(i), value.numbers[i]});
    }
    return row;
  }

  const std::vector<Value>& values_;
  Program& program_;
  std::vector<std::uint32_t> rows_;  // by value
  std::map<std::vector<std::uint64_t>, std::uint32_t> constants_;
};

Operand Emitter::constant(std::vector<double> numbers) {
  const auto width = static_cast<std::uint32_t>(numbers.size());
  values_.push_back({Source::constant, width, std::move(numbers)});
  return {static_cast<std::uint32_t>(values_.size() - 1), 0, width};
}

Operand Emitter::input(std::vector<double> initial) {
  const auto width = static_cast<std::uint32_t>(initial.size());
  values_.push_back({Source::input, width, std::move(initial)});
  return {static_cast<std::uint32_t>(values_.size() - 1), 0, width};
}

bool Emitter::all_constant(const std::vector<Operand>& operands) const {
  for (const Operand& operand : operands) {
    if (values_[operand.value].source != Source::constant) return false;
  }
  return true;
}

std::vector<double> Emitter::fold(Op op, const std::vector<Operand>& arguments,
                                  const std::vector<double>& data, std::uint32_t width) const {
  std::vector<Register> places;
  std::vector<double> registers;
  for (const Operand& operand : arguments) {
    places.push_back({static_cast<std::uint32_t>(registers.size() / kLanes), operand.width});
    for (std::uint32_t i = 0; i < operand.width; ++i) {
      const double number = values_[operand.value].numbers[operand.offset + i];
      registers.insert(registers.end(), kLanes, number);
    }
  }
  const Register out{static_cast<std::uint32_t>(registers.size() / kLanes), width};
  registers.resize(registers.size() + static_cast<std::size_t>(width) * kLanes);
  row(op).kernel({registers.data(), out, places.data(), static_cast<std::uint32_t>(places.size()),
                  data.data()});
  std::vector<double> numbers;
  for (std::uint32_t i = 0; i < width; ++i) {
    numbers.push_back(registers[static_cast<std::size_t>(out.row + i) * kLanes]);
  }
  return numbers;
}

Operand Emitter::emit(Op op, const std::vector<Operand>& arguments, const std::vector<double>& data,
                      std::uint32_t width, std::uint32_t node) {
  assert(row(op).arguments < 0 || row(op).arguments == static_cast<int>(arguments.size()));
  if (all_constant(arguments)) return constant(fold(op, arguments, data, width));
  values_.push_back({Source::computed, width, {}});
  const auto value = static_cast<std::uint32_t>(values_.size() - 1);
  pending_.push_back({op, value, arguments_.size(), static_cast<std::uint32_t>(arguments.size()),
                      data_.size(), node});
  arguments_.insert(arguments_.end(), arguments.begin(), arguments.end());
  data_.insert(data_.end(), data.begin(), data.end());
  return {value, 0, width};
}

Program Emitter::finish(const std::vector<Operand>& inputs,
                        const std::vector<Operand>& outputs) const {
  Program program;
  Rows rows(values_, program);
  for (const Operand& input : inputs) program.inputs.push_back(rows.of(input));
  for (const Pending& p : pending_) {
    Instruction instruction;
    instruction.op = p.op;
    instruction.first_argument = static_cast<std::uint32_t>(program.arguments.size());
    instruction.argument_count = p.argument_count;
    instruction.data = static_cast<std::uint32_t>(p.data);
    instruction.node = p.node;
    for (std::uint32_t i = 0; i < p.argument_count; ++i) {
      program.arguments.push_back(rows.of(arguments_[p.first_argument + i]));
    }
    instruction.out = rows.of({p.value, 0, values_[p.value].width});
    program.instructions.push_back(instruction);
  }
  for (const Operand& output : outputs) program.outputs.push_back(rows.of(output));
  program.data = data_;
  return program;
}

}  // namespace rigc::eval
