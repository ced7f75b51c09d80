// SPDX-License-Identifier: MIT
// The lower bound as one number.
#pragma once

#include "bench/bench.h"

namespace rigc::bench {

/// Seconds that the hand-written evaluation of 300 transforms takes for each in one frame, in
/// doubles, now.
double bound_seconds(bool avx2);

}  // namespace rigc::bench
