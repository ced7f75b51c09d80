// SPDX-License-Identifier: MIT
// The lower bound as one number.
#pragma once

#include "bench/bench.h"
#include "eval/isa.h"

namespace rigc::bench {

/// Seconds that the hand-written evaluation of 300 transforms takes for each in one frame, in
/// doubles with an instruction set, now.
double bound_seconds(eval::Isa isa);

}  // namespace rigc::bench
