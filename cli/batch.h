// SPDX-License-Identifier: MIT
// What commands over many files share: options, progress, summary, report.
// Test: tests/faults/interruption_test.cpp
#pragma once

#include <optional>
#include <string>

#include "cli/timing.h"
#include "pipeline/batch.h"

namespace rigc::cli {

struct BatchOptions {
  pipeline::BatchRequest request;
  std::optional<double> jobs;
  Timing timing;
};

/// Where the output of a command goes that is told nothing.
enum class Target { in_place, elsewhere };

/// FILE... --jobs --report --resume --out-dir -o --time --trace, and --backup for what is replaced
/// in place.
void declare_batch(Options& options, BatchOptions& batch, Target target = Target::in_place);

/// --jobs into the request; false: it was no number of jobs, which was reported.
bool read_jobs(BatchOptions& batch, Diagnostics& diagnostics);

/// Everything that a command does with its files, measured where --time or --trace asks for it.
void run_timed(const BatchOptions& batch, Session& session, const std::function<void()>& work);

/// Does the work for all files: progress and their diagnostics go to stderr as they come, the
/// summary (with --json the report) to stdout. `lists_all` prints every file's line, however many.
void run_batch(BatchOptions& batch, const pipeline::Work& work, bool lists_all, Session& session);

}  // namespace rigc::cli
