// SPDX-License-Identifier: MIT
// Many files replaced in place, by works that do nothing else: what the machine can write and
// flush, what the batch adds to it, and what it costs where nothing is to be done. The aim: as many
// files a second as a plain loop in as many threads.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "bench/bench.h"
#include "pipeline/batch.h"

namespace {

using namespace rigc;
namespace fs = std::filesystem;

constexpr int kFiles = 300;
constexpr std::size_t kBytes = 3'000'000;
constexpr unsigned kJobs = 2;

std::vector<std::string> make_files(const std::string& folder, int count, std::size_t bytes) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::string text(bytes, '\0');
  for (std::size_t i = 0; i < bytes; ++i) text[i] = static_cast<char>(i * i >> 7);
  std::vector<std::string> files;
  for (int i = 0; i < count; ++i) {
    files.push_back(folder + "/" + std::to_string(10'000 + i) + ".glb");
    std::ofstream(files.back(), std::ios::binary) << text;
  }
  ::sync();
  return files;
}

/// Copies a file inside the system, flushes the copy and gives it the file's name.
bool replace_plainly(const std::string& path) {
  const std::string copy = path + ".copy";
  const int from = ::open(path.c_str(), O_RDONLY);
  const int to = ::open(copy.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ssize_t copied = 0;
  do copied = ::copy_file_range(from, nullptr, to, nullptr, kBytes, 0);
  while (copied > 0);
  const bool done = copied == 0 && ::fsync(to) == 0;
  ::close(from);
  ::close(to);
  return done && ::rename(copy.c_str(), path.c_str()) == 0;
}

void plain(benchmark::State& state) {
  const auto files = make_files(bench::temporary_file("batch"), kFiles, kBytes);
  for ([[maybe_unused]] auto iteration : state) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> good{true};
    std::vector<std::thread> threads;
    for (unsigned job = 0; job < kJobs; ++job)
      threads.emplace_back([&] {
        for (std::size_t i; (i = next++) < files.size();)
          if (!replace_plainly(files[i])) good = false;
      });
    for (std::thread& thread : threads) thread.join();
    if (!good) state.SkipWithError("cannot copy");
  }
  state.SetItemsProcessed(state.iterations() * kFiles);
  fs::remove_all(bench::temporary_file("batch"));
}

pipeline::FileResult replace(const pipeline::FileWork& work, Diagnostics& diagnostics) {
  pipeline::FileResult result;
  const auto lock = FileLock::take(work.input, diagnostics);
  const auto bytes = Bytes::open(work.input, UINT64_MAX, diagnostics);
  if (!lock || !bytes) return result;
  WriteSettings settings;
  settings.expected = bytes->version();
  write_file(work.output, {*bytes}, diagnostics, settings);
  return result;
}

pipeline::FileResult pass(const pipeline::FileWork&, Diagnostics&) { return {}; }

void batch(benchmark::State& state, const pipeline::Work& work, int count, std::size_t bytes) {
  const std::string folder = bench::temporary_file("batch");
  make_files(folder, count, bytes);
  pipeline::BatchRequest request;
  request.inputs = {folder};
  request.jobs = kJobs;
  for ([[maybe_unused]] auto iteration : state) {
    Diagnostics diagnostics;
    const auto done = run_batch(request, work, diagnostics);
    if (!done || done->exit_status() != 0) state.SkipWithError("a file failed");
  }
  state.SetItemsProcessed(state.iterations() * count);
  fs::remove_all(folder);
}

}  // namespace

void rigc::bench::add_batch_benchmarks() {
  const auto add = [](const char* name, auto... what) {
    benchmark::RegisterBenchmark(name, what...)
        ->Iterations(1)
        ->Repetitions(5)
        ->ReportAggregatesOnly()
        ->ComputeStatistics("min", least)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("batch/plain_copy_300x3MB", plain);
  add("batch/replace_300x3MB", batch, replace, kFiles, kBytes);
  add("batch/nothing_to_do_10000", batch, pass, 10'000, std::size_t{1});
}
