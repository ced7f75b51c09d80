// SPDX-License-Identifier: MIT
// The benchmarks of this folder; each file registers its own.
#pragma once

#include <vector>

namespace rigc::bench {

void add_process_benchmarks();
void add_stage_benchmarks();
void add_eval_benchmarks();

/// Minimum of the repetitions, beside the median the number that counts on a shared machine.
double least(const std::vector<double>& times);

}  // namespace rigc::bench
