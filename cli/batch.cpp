// SPDX-License-Identifier: MIT
// Commands over many files. Test: tests/faults/interruption_test.cpp
#include "cli/batch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>

#include "base/text.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "pipeline/batch_codes.h"
#include "pipeline/batch_progress.h"

namespace rigc::cli {
namespace {

/// So many files' lines are printed without being asked for.
constexpr std::size_t kFewFiles = 20;

double seconds_now() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

std::string summary(const pipeline::Batch& batch, bool lists_all) {
  std::string text;
  const bool lists = lists_all || batch.entries.size() <= kFewFiles;
  for (const pipeline::BatchEntry& entry : batch.entries)
    if (lists && !entry.summary.empty())
      text += fmt::format("{}: {}\n", printable(entry.output), entry.summary);
  const bool many = batch.entries.size() + batch.remaining > 1;
  return many ? text + batch_table(batch) : text;
}

}  // namespace

bool read_jobs(BatchOptions& batch, Diagnostics& diagnostics) {
  const double jobs = batch.jobs.value_or(0);
  if (!batch.jobs || (jobs >= 1 && jobs <= 1e6 && jobs == std::floor(jobs))) {
    batch.request.jobs = static_cast<unsigned>(jobs);
    return true;
  }
  diagnostics.report(pipeline::codes::kBadOptions, Place(),
                     "--jobs takes how many threads work at a time, 1 or more");
  return false;
}

void declare_batch(Options& options, BatchOptions& batch, Target target) {
  pipeline::BatchRequest& request = batch.request;
  const bool in_place = target == Target::in_place;
  const std::string otherwise = in_place ? " (default: in place)" : "";
  options.positionals("FILE", request.inputs,
                      "Files, folders, patterns in quotes ('shots/**/a*.glb'), @LIST for a file "
                      "with one path per line");
  options.text("-o,--output", "OUT", request.output, false, "Write the only file here" + otherwise);
  options.text("--out-dir", "DIR", request.out_dir, false,
               "Write into this folder, mirrored" + otherwise);
  if (in_place)
    options.text("--backup", "DIR", request.backup, false,
                 "Copy originals into this folder before they are replaced");
  options.number("--jobs", "N", batch.jobs,
                 "Threads that work at a time (default: one for each processor)");
  options.text("--report", "R.json", request.report, false,
               "Write what became of each file, also when interrupted");
  options.text("--resume", "R.json", request.resume, false,
               "Leave out what this report of an earlier run says is done");
  declare_timing(options, batch.timing);
}

void run_timed(const BatchOptions& batch, Session& session, const std::function<void()>& work) {
  run_timed(batch.timing, session, work, {batch.request.report, batch.request.resume});
}

void run_batch(BatchOptions& batch, const pipeline::Work& work, bool lists_all, Session& session) {
  if (!read_jobs(batch, session.diagnostics)) return;
  batch.request.stop = &watch_for_interruption();
  batch.request.colour = wants_colour();
  pipeline::ProgressPrinter progress(
      ::isatty(STDERR_FILENO) != 0, seconds_now,
      [](const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); });
  const auto done = pipeline::run_batch(batch.request, work, session.diagnostics, &progress);
  progress.end();
  if (!done) return;
  session.status = done->exit_status();
  session.out = session.json ? done->report : summary(*done, lists_all);
}

}  // namespace rigc::cli
