// SPDX-License-Identifier: MIT
// Updates of shots of 3 MB with the biped and 34,000 keys on its controls, to a version with
// another content: one as a whole process, and many with two jobs. The aims: 40 ms, and 100 files a
// second.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/files.h"
#include "bench/bench.h"

namespace {

using namespace rigc;
namespace fs = std::filesystem;

constexpr int kFiles = 200;
constexpr std::size_t kFrames = 217, kBytes = 3'000'000;
constexpr double kFps = 24;
const std::string kTemplates = std::string(RIGC_SOURCE_DIR) + "/templates";

/// A folder with `templates`, a newer biped with larger shapes, and `shot.glb`.
bool make_shot(const std::string& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  if (!bench::write_shot(folder + "/shot.glb", kFrames, kFps, kBytes)) return false;
  fs::copy(kTemplates, folder + "/templates", fs::copy_options::recursive);
  Diagnostics diagnostics;
  auto text = read_file(folder + "/templates/biped.yaml", 1 << 20, diagnostics);
  const std::size_t version = text->find("\nversion: ");
  text->replace(version, text->find('\n', version + 1) - version, "\nversion: 1000");
  std::ofstream(folder + "/templates/biped.yaml", std::ios::binary) << *text;
  return diagnostics.ok();
}

void one(benchmark::State& state) {
  const std::string folder = bench::temporary_file("update");
  if (!make_shot(folder)) return state.SkipWithError("cannot build");
  for ([[maybe_unused]] auto iteration : state) {
    state.PauseTiming();
    fs::copy_file(folder + "/shot.glb", folder + "/one.glb", fs::copy_options::overwrite_existing);
    state.ResumeTiming();
    if (!bench::run_process(
            {RIGC_BINARY, "update", folder + "/one.glb", "--templates", folder + "/templates"}))
      state.SkipWithError("failed");
  }
  fs::remove_all(folder);
}

void many(benchmark::State& state) {
  const std::string folder = bench::temporary_file("update");
  if (!make_shot(folder)) return state.SkipWithError("cannot build");
  fs::create_directories(folder + "/shots");
  for ([[maybe_unused]] auto iteration : state) {
    state.PauseTiming();
    for (int i = 0; i < kFiles; ++i)
      fs::copy_file(folder + "/shot.glb", folder + "/shots/" + std::to_string(i) + ".glb",
                    fs::copy_options::overwrite_existing);
    state.ResumeTiming();
    if (!bench::run_process({RIGC_BINARY, "update", folder + "/shots", "--jobs", "2", "--templates",
                             folder + "/templates"}))
      state.SkipWithError("failed");
  }
  state.SetItemsProcessed(state.iterations() * kFiles);
  fs::remove_all(folder);
}

}  // namespace

void rigc::bench::add_update_benchmarks() {
  const auto add = [](const char* name, auto what, int repetitions) {
    benchmark::RegisterBenchmark(name, what)
        ->Repetitions(repetitions)
        ->ReportAggregatesOnly()
        ->ComputeStatistics("min", least)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("update/one_3MB_34000_keys", one, 10);
  add("update/200x3MB", many, 3);
}
