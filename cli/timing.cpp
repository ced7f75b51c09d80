// SPDX-License-Identifier: MIT
// Where the time of a command goes. Test: tests/cli/trace_test.cpp
#include "cli/timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/files.h"
#include "base/text.h"
#include "base/trace.h"
#include "pipeline/batch_codes.h"
#include "pipeline/instruction_set.h"

namespace rigc::cli {
namespace {

bool same_file(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (a.empty() || b.empty()) return false;
  const auto path = resolved_path(a);
  return path && path == resolved_path(b);
}

/// An empty trace takes the file's place: what cannot be written is found out before the work.
bool begin_trace(const std::string& path, const std::vector<std::string>& others,
                 Diagnostics& diagnostics) {
  const auto refuse = [&](const char* what, const char* hint) {
    diagnostics.report(pipeline::codes::kBadOptions, Place(),
                       fmt::format("\"{}\" {}", printable(path), what), hint);
    return false;
  };
  if (!ends_with(path, ".json"))
    return refuse("does not end in .json", "--trace names the file that the trace goes into");
  if (std::any_of(others.begin(), others.end(),
                  [&](const std::string& other) { return same_file(path, other); }))
    return refuse("is another file of this command", "--trace needs a file of its own");
  return write_file(path, {trace::as_json({})}, diagnostics);
}

/// What the table and the trace say beside times.
std::vector<trace::Fact> facts() {
  return {{"instruction set", std::string(pipeline::instruction_set())}};
}

std::string time_text(const std::vector<trace::ThreadEvents>& threads) {
  std::string text = trace::as_table(threads);
  for (const trace::Fact& fact : facts()) text += fmt::format("{}: {}\n", fact.name, fact.value);
  return text;
}

}  // namespace

void declare_timing(Options& options, Timing& timing) {
  options.flag("--time", timing.table, "Say on stderr where the time went");
  options.text("--trace", "T.json", timing.trace, false,
               "Write where the time went, for chrome://tracing or ui.perfetto.dev");
}

void run_timed(const Timing& timing, Session& session, const std::function<void()>& work,
               const std::vector<std::string>& others) {
  if (timing.trace.empty() && !timing.table) return work();
  if (!timing.trace.empty() && !begin_trace(timing.trace, others, session.diagnostics)) return;
  trace::Recorder recorder;
  {
    const trace::Attach attach(&recorder);
    work();
  }
  const std::vector<trace::ThreadEvents> threads = recorder.threads();
  if (timing.table) session.notes += time_text(threads);
  if (!timing.trace.empty())
    write_file(timing.trace, {trace::as_json(threads, facts())}, session.diagnostics);
}

}  // namespace rigc::cli
