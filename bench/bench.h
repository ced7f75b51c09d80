// SPDX-License-Identifier: MIT
// The benchmarks of this folder; each file registers its own.
#pragma once

#include <string>
#include <vector>

namespace rigc::bench {

void add_process_benchmarks();
void add_status_benchmarks();
void add_large_benchmarks();
void add_json_benchmarks();
void add_stage_benchmarks();
void add_eval_benchmarks();
void add_batch_benchmarks();
void add_update_benchmarks();

/// Runs a program to its end, its stdout thrown away; true where it ended with status 0.
bool run_process(std::vector<std::string> words);

/// A character of the corpus, by its path there; empty where there is no corpus.
std::string corpus_file(const std::string& path);
/// A file of the benchmarks' own in the folder for temporary ones.
std::string temporary_file(const std::string& name);

/// Minimum of the repetitions, beside the median the number that counts on a shared machine.
double least(const std::vector<double>& times);

}  // namespace rigc::bench
