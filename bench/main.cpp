// SPDX-License-Identifier: MIT
// Registers and runs all benchmarks; arguments are Google Benchmark's.
#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>

#include "bench/bench.h"

double rigc::bench::least(const std::vector<double>& times) {
  return *std::min_element(times.begin(), times.end());
}

double rigc::bench::thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int main(int argc, char** argv) {
  rigc::bench::add_process_benchmarks();
  rigc::bench::add_status_benchmarks();
  rigc::bench::add_large_benchmarks();
  rigc::bench::add_json_benchmarks();
  rigc::bench::add_stage_benchmarks();
  rigc::bench::add_kernel_benchmarks();
  rigc::bench::add_bound_benchmarks();
  rigc::bench::add_eval_benchmarks();
  rigc::bench::add_bake_benchmarks();
  rigc::bench::add_batch_benchmarks();
  rigc::bench::add_update_benchmarks();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
