// SPDX-License-Identifier: MIT
// Order and rows. Test: tests/eval/schedule_test.cpp
#include "eval/schedule.h"

#include <algorithm>

#include "eval/kernels/spline_table.h"

namespace rigc::eval {

namespace {

constexpr std::uint32_t kNoRow = UINT32_MAX;
constexpr std::uint32_t kNever = UINT32_MAX;

// Computed values that outputs need, each after what it needs: depth first.
std::vector<std::uint32_t> order_of(const Emitter& emitter, const std::vector<Operand>& outputs) {
  struct Frame {
    std::uint32_t value;
    std::uint32_t next;
  };
  const std::vector<Definition>& values = emitter.values();
  std::vector<bool> seen(values.size());
  std::vector<std::uint32_t> order;
  std::vector<Frame> stack;
  const auto open = [&](std::uint32_t value) {
    if (values[value].source != Source::computed || seen[value]) return;
    seen[value] = true;
    stack.push_back({value, 0});
  };
  for (const Operand& output : outputs) {
    open(output.value);
    while (!stack.empty()) {
      Frame& frame = stack.back();
      const Definition& d = values[frame.value];
      if (frame.next < d.argument_count) {
        open(emitter.arguments(d)[frame.next++].value);
      } else {
        order.push_back(frame.value);
        stack.pop_back();
      }
    }
  }
  return order;
}

class Scheduler {
 public:
  Scheduler(const Emitter& emitter, const std::vector<Operand>& outputs)
      : emitter_(emitter),
        order_(order_of(emitter, outputs)),
        rows_(emitter.values().size(), kNoRow),
        last_use_(emitter.values().size(), kNever),
        first_read_(emitter.values().size(), kNoRow) {
    for (std::uint32_t step = 0; step < order_.size(); ++step) {
      for (const Operand& a : emitter.arguments(emitter.values()[order_[step]])) {
        last_use_[a.value] = step;
        read(a);
      }
    }
    for (const Operand& output : outputs) {
      last_use_[output.value] = kNever;
      read(output);
    }
  }

  Program take(const std::vector<Operand>& inputs, const std::vector<Operand>& outputs) {
    for (const Operand& input : inputs) program_.inputs.push_back(place(input));
    for (const std::uint32_t value : order_) {
      for (const Operand& a : emitter_.arguments(emitter_.values()[value])) {
        if (rows_[a.value] == kNoRow) place(a);
      }
    }
    for (const Operand& output : outputs) place(output);
    for (std::uint32_t step = 0; step < order_.size(); ++step) append(step);
    for (const Operand& output : outputs) program_.outputs.push_back(place(output));
    return std::move(program_);
  }

 private:
  void read(const Operand& operand) {
    first_read_[operand.value] = std::min(first_read_[operand.value], operand.offset);
  }

  const Definition& definition(std::uint32_t value) const { return emitter_.values()[value]; }

  // Where an operand lies; what has no row yet and is not computed gets its own, and so do outputs.
  Register place(const Operand& operand) {
    std::uint32_t& row = rows_[operand.value];
    const Definition& d = definition(operand.value);
    const bool own = d.source != Source::computed || last_use_[operand.value] == kNever;
    if (row == kNoRow && own) {
      row = program_.rows;
      program_.rows += d.width;
      if (d.source != Source::computed) fill(row, emitter_.data(d));
    }
    return {row + operand.offset, operand.width};
  }

  void fill(std::uint32_t row, std::span<const double> numbers) {
    for (const double n : numbers) program_.constants.push_back({row++, n});
  }

  void append(std::uint32_t step) {
    const Definition& d = definition(order_[step]);
    Instruction instruction;
    instruction.op = d.op;
    instruction.first_argument = static_cast<std::uint32_t>(program_.arguments.size());
    instruction.argument_count = d.argument_count;
    instruction.data = static_cast<std::uint32_t>(program_.data.size());
    instruction.data_count = d.data_count;
    instruction.node = d.node;
    for (const Operand& a : emitter_.arguments(d)) program_.arguments.push_back(place(a));
    const std::span<const double> data = emitter_.data(d);
    program_.data.insert(program_.data.end(), data.begin(), data.end());
    // A curve whose length nobody reads is not measured.
    if (d.op == Op::spline && first_read_[order_[step]] >= spline::kFirstWorld)
      program_.data[instruction.data + spline::kMeasures] = 0;
    // The result has rows before those of dead arguments are free: no kernel may read what it has
    // written.
    if (rows_[order_[step]] == kNoRow) rows_[order_[step]] = take_rows(d.width);
    instruction.out = {rows_[order_[step]], d.width};
    program_.instructions.push_back(instruction);
    for (const Operand& a : emitter_.arguments(d)) release(a.value, step);
  }

  std::vector<std::uint32_t>& free_of(std::uint32_t width) {
    if (width >= free_.size()) free_.resize(width + 1);
    return free_[width];
  }

  std::uint32_t take_rows(std::uint32_t width) {
    std::vector<std::uint32_t>& free = free_of(width);
    std::uint32_t row = program_.rows;
    if (free.empty()) {
      program_.rows += width;
    } else {
      row = free.back();
      free.pop_back();
    }
    return row;
  }

  void release(std::uint32_t value, std::uint32_t step) {
    if (definition(value).source != Source::computed || last_use_[value] != step) return;
    last_use_[value] = kNever;  // once, though it may be an argument twice
    free_of(definition(value).width).push_back(rows_[value]);
  }

  const Emitter& emitter_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> rows_;      // by value: the first
  std::vector<std::uint32_t> last_use_;  // by value: step; never: it is an output, or free already
  std::vector<std::uint32_t> first_read_;  // by value: the first of its rows that anybody reads
  std::vector<std::vector<std::uint32_t>> free_;  // by width: first rows
  Program program_;
};

}  // namespace

Program schedule(const Emitter& emitter, const std::vector<Operand>& inputs,
                 const std::vector<Operand>& outputs) {
  return Scheduler(emitter, outputs).take(inputs, outputs);
}

}  // namespace rigc::eval
