// SPDX-License-Identifier: MIT
// The benchmarks of this folder; each file registers its own.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rigc::bench {

void add_process_benchmarks();
void add_status_benchmarks();
void add_large_benchmarks();
void add_json_benchmarks();
void add_stage_benchmarks();
void add_kernel_benchmarks();
void add_eval_benchmarks();
void add_bound_benchmarks();
void add_bake_benchmarks();
void add_batch_benchmarks();
void add_update_benchmarks();

/// Runs a program to its end, its stdout thrown away; true where it ended with status 0.
bool run_process(std::vector<std::string> words);
/// Processor seconds of all programs that have been run so far.
double children_seconds();

/// Features of the biped, NAME=on|off: everything that it has, with the spine on a curve.
std::vector<std::string> all_features();
/// A character of the corpus, by its path there; empty where there is no corpus.
std::string corpus_file(const std::string& path);
/// A file of the benchmarks' own in the folder for temporary ones.
std::string temporary_file(const std::string& name);

/// Writes the biped with a clip of `frames` keys at `fps` on translation and rotation of every
/// control, padded to `bytes`.
bool write_shot(const std::string& path, std::size_t frames, double fps, std::size_t bytes);

/// Minimum of the repetitions, beside the median the number that counts on a shared machine.
double least(const std::vector<double>& times);

/// Processor seconds that this thread has used.
double thread_seconds();

/// Processor seconds of one call of `work` in many batches of about 0.1 ms: the tenth part of them
/// was faster. What the machine can do while nobody else is at it, less clocks that err.
template <class Work>
double least_batch(Work work, double for_seconds) {
  const auto time = [&](int calls) {
    const double begin = thread_seconds();
    for (int i = 0; i < calls; ++i) work();
    return thread_seconds() - begin;
  };
  work();
  const int calls = std::max(1, static_cast<int>(1e-4 / std::max(time(1), 1e-9)));
  std::vector<double> batches;
  for (double spent = 0; spent < for_seconds || batches.empty(); spent += batches.back())
    batches.push_back(time(calls));
  const auto tenth = batches.begin() + static_cast<std::ptrdiff_t>(batches.size() / 10);
  std::nth_element(batches.begin(), tenth, batches.end());
  return *tenth / calls;
}

/// The same inside a benchmark, whose own time is that of all calls.
template <class Work>
double least_seconds(benchmark::State& state, Work work) {
  for ([[maybe_unused]] auto iteration : state) work();
  return least_batch(work, 0.05);
}

}  // namespace rigc::bench
