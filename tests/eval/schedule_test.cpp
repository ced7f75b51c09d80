// SPDX-License-Identifier: MIT
// Order and rows of programs: nothing is overwritten while it is needed, rows are few, and who
// needs nothing is left out.
#include "eval/schedule.h"

#include <doctest/doctest.h>

#include <array>
#include <map>

#include "tests/eval/kernel_runner.h"

namespace rigc {
namespace {

using eval::Emitter;
using eval::Op;
using eval::Operand;
using eval::Program;

// Random sums of what is there already; what each comes to is followed beside.
struct Sums {
  Emitter emitter;
  std::vector<Operand> inputs, values;
  std::vector<double> expected;

  explicit Sums(test::Random& random) {
    for (int i = 0; i < 5; ++i) {
      const double number = i + 1;
      inputs.push_back(emitter.input(std::array{number}));
      values.push_back(inputs.back());
      expected.push_back(number);
    }
    values.push_back(emitter.constant({0.5}));
    expected.push_back(0.5);
    for (int i = 0; i < 200; ++i) {
      const std::size_t recent = std::min<std::size_t>(values.size(), 20);
      const std::size_t a = values.size() - 1 - random.below(recent);
      const std::size_t b = random.below(values.size());
      const Op op = random.chance(70) ? Op::add : Op::min;
      values.push_back(emitter.emit(op, {values[a], values[b]}, {}, 1, 0));
      const double x = expected[a], y = expected[b];
      expected.push_back(op == Op::add ? x + y : std::min(x, y));
    }
  }
};

TEST_CASE("eval schedule: reused rows never lose what is still needed") {
  test::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Sums sums(random);
    std::vector<Operand> outputs;
    std::vector<double> expected;
    for (int k = 0; k < 6; ++k) {
      const std::size_t at = random.below(sums.values.size());
      outputs.push_back(sums.values[at]);
      expected.push_back(sums.expected[at]);
    }
    const Program program = eval::schedule(sums.emitter, sums.inputs, outputs);
    eval::Instance instance(program);
    for (int run = 0; run < 2; ++run) {  // the second on what the first has left
      instance.run();
      for (std::size_t k = 0; k < outputs.size(); ++k) {
        CHECK(instance.output(k)[0] == expected[k]);
        CHECK(instance.output(k)[eval::kLanes - 1] == expected[k]);
      }
      for (std::size_t k = 0; k < 5; ++k) CHECK(instance.input(k)[0] == sums.expected[k]);
    }
  }
}

TEST_CASE("eval schedule: no result lies on an argument of its instruction") {
  test::Random random(2);
  const Sums sums(random);
  const Program program = eval::schedule(sums.emitter, sums.inputs, {sums.values.back()});
  for (const eval::Instruction& i : program.instructions) {
    for (std::uint32_t a = 0; a < i.argument_count; ++a) {
      const eval::Register& from = program.arguments[i.first_argument + a];
      CHECK((from.row + from.width <= i.out.row || i.out.row + i.out.width <= from.row));
    }
  }
}

TEST_CASE("eval schedule: a chain of any length needs the same rows") {
  std::map<int, std::uint32_t> rows;
  for (const int length : {10, 1000}) {
    Emitter emitter;
    const Operand input = emitter.input(std::array{1.0});
    Operand at = input;
    for (int i = 0; i < length; ++i) at = emitter.emit(Op::add, {at, input}, {}, 1, 0);
    const Program program = eval::schedule(emitter, {input}, {at});
    CHECK(program.instructions.size() == static_cast<std::size_t>(length));
    rows[length] = program.rows;
  }
  CHECK(rows[10] == 4);
  CHECK(rows[1000] == 4);
}

TEST_CASE("eval schedule: only what outputs need, each after what it needs") {
  Emitter emitter;
  const Operand input = emitter.input(std::array{2.0}), unused = emitter.input(std::array{3.0});
  const Operand twice = emitter.emit(Op::add, {input, input}, {}, 1, 0);
  emitter.emit(Op::exp, {twice}, {}, 1, 0);
  const Operand root = emitter.emit(Op::sqrt, {twice}, {}, 1, 0);
  const Program program = eval::schedule(emitter, {input, unused}, {root, twice, input});
  REQUIRE(program.instructions.size() == 2);
  CHECK(program.instructions[0].op == Op::add);
  CHECK(program.instructions[1].op == Op::sqrt);
  CHECK(program.outputs[2].row == program.inputs[0].row);
  CHECK(program.inputs[1].row != program.inputs[0].row);
}

}  // namespace
}  // namespace rigc
