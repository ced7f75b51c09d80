// SPDX-License-Identifier: MIT
// The registers of one thread, and the loop that runs a program. Test: tests/eval/program_test.cpp
#include "eval/kernels/table.h"
#include "eval/program.h"

namespace rigc::eval {

Instance::Instance(const Program& program, Isa isa)
    : program_(program),
      isa_(isa),
      registers_(static_cast<std::size_t>(program.rows) * kLanes, 0.0) {
  for (const Program::Constant& c : program.constants) {
    double* at = registers_.data() + static_cast<std::size_t>(c.row) * kLanes;
    for (int lane = 0; lane < kLanes; ++lane) at[lane] = c.value;
  }
}

double* Instance::input(std::size_t index) {
  return registers_.data() + static_cast<std::size_t>(program_.inputs[index].row) * kLanes;
}

const double* Instance::output(std::size_t index) const {
  return registers_.data() + static_cast<std::size_t>(program_.outputs[index].row) * kLanes;
}

void Instance::run() {
  const KernelRow* const kernels = &row(Op{}, isa_);
  const Register* const arguments = program_.arguments.data();
  const double* const data = program_.data.data();
  for (const Instruction& i : program_.instructions)
    kernels[static_cast<std::size_t>(i.op)].kernel(
        {registers_.data(), i.out, arguments + i.first_argument, i.argument_count, data + i.data});
}

}  // namespace rigc::eval
