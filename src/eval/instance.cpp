// SPDX-License-Identifier: MIT
// The registers of one thread, and the loop that runs a program. Test: tests/eval/program_test.cpp
#include "eval/kernels/table.h"
#include "eval/program.h"

namespace rigc::eval {

Instance::Instance(const Program& program, Isa isa)
    : program_(program), kernels_(kernels(isa)), rows_(program.rows) {
  for (const Program::Constant& c : program.constants)
    for (double& lane : rows_[c.row].lanes) lane = c.value;
}

double* Instance::input(std::size_t index) { return rows_[program_.inputs[index].row].lanes; }

const double* Instance::output(std::size_t index) const {
  return rows_[program_.outputs[index].row].lanes;
}

void Instance::run() {
  double* registers = rows_.empty() ? nullptr : rows_[0].lanes;
  for (const Instruction& i : program_.instructions) {
    const Register* arguments = program_.arguments.data() + i.first_argument;
    const double* data = program_.data.data() + i.data;
    kernels_[static_cast<std::size_t>(i.op)].kernel(
        {registers, i.out, arguments, i.argument_count, data});
  }
}

}  // namespace rigc::eval
