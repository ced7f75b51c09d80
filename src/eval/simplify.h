// SPDX-License-Identifier: MIT
// Instructions that need not be: some of their operands are constants of which nothing, or all, of
// another operand is left (times 0 or 1, a choice that is made, part 0 of the way). With attributes
// at their defaults that is much of what modules compute. Test: tests/eval/simplify_test.cpp
#pragma once

#include <optional>

#include "eval/emitter.h"

namespace rigc::eval {

/// What an instruction without a table gives, where that is known without it or a cheaper one gives
/// it: the same values but for rounding, the sign of 0, and the length and sign of quaternions.
std::optional<Operand> simplified(Emitter& emitter, Op op, std::span<const Operand> arguments,
                                  std::uint32_t node);

}  // namespace rigc::eval
