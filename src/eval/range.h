// SPDX-License-Identifier: MIT
// Between which numbers a value of a program lies for certain, whatever its inputs are.
// Test: tests/eval/range_test.cpp
#pragma once

#include "eval/emitter.h"

namespace rigc::eval {

struct Range {
  double least, most;  ///< infinite: nothing is known
};

/// Of an operand of one number; to within rounding.
Range range_of(const Emitter& emitter, const Operand& number);

}  // namespace rigc::eval
