// SPDX-License-Identifier: MIT
// A command over many files as rigc has them, whose work is small and plain: each file gets a "+"
// at its end, or grows to the number of bytes that its only line says. So that what the file layer
// and the batch promise is tested apart from rigs.
//   append_command BACKUP REPORT RESUME JOBS FILE... (empty: without)
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "cli/batch.h"
#include "cli/terminal.h"

namespace {

using namespace rigc;

/// Milliseconds that each file takes, so that signals meet files in work.
int pace() {
  const char* value = std::getenv("APPEND_PACE_MS");
  return value ? std::atoi(value) : 0;
}

pipeline::FileResult append(const pipeline::FileWork& work, Diagnostics& diagnostics) {
  pipeline::FileResult result;
  const auto lock = FileLock::take(work.input, diagnostics);
  if (!lock) return result;
  const auto bytes = Bytes::open(work.input, std::uint64_t{1} << 32, diagnostics);
  if (!bytes) return result;
  std::this_thread::sleep_for(std::chrono::milliseconds(pace()));
  WriteSettings settings;
  settings.expected = bytes->version();
  if (!keep_original(work, *bytes, diagnostics)) return result;
  if (!write_file(work.output, {*bytes, "+"}, diagnostics, settings)) return result;
  result.outcome = pipeline::FileResult::Outcome::changed;
  result.bytes = bytes->size() + 1;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  cli::Session session;
  cli::BatchOptions batch;
  batch.request.backup = argv[1];
  batch.request.report = argv[2];
  batch.request.resume = argv[3];
  batch.jobs = std::atof(argv[4]);
  batch.request.inputs.assign(argv + 5, argv + argc);
  batch.request.command = "append";
  cli::run_batch(batch, append, false, session);
  std::fputs(render(session.diagnostics, cli::wants_colour()).c_str(), stderr);
  std::fputs(session.out.c_str(), stdout);
  if (session.diagnostics.file_system_refused()) return 3;
  return session.diagnostics.ok() ? session.status : 1;
}
