// SPDX-License-Identifier: MIT
// From values to a program: what outputs need, in an order in which values are used soon after they
// are made, in rows that are reused when their value is dead. Time is linear in what is needed.
// Test: tests/eval/schedule_test.cpp
#pragma once

#include <vector>

#include "eval/emitter.h"
#include "eval/program.h"

namespace rigc::eval {

/// Rows of inputs, constants and outputs are theirs alone; every other row is overwritten.
Program schedule(const Emitter& emitter, const std::vector<Operand>& inputs,
                 const std::vector<Operand>& outputs);

}  // namespace rigc::eval
