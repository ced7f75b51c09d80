// SPDX-License-Identifier: MIT
// Bakes as whole processes: 250 frames of the biped with keys on translation and rotation of all
// its controls. `cpu_ms` is the processor time. The aim: 30 ms.
#include <filesystem>
#include <string>

#include "bench/bench.h"

namespace {

using namespace rigc;

constexpr std::size_t kFrames = 250;
constexpr double kFps = 30;

void bake(benchmark::State& state, const std::vector<std::string>& options) {
  const std::string shot = bench::temporary_file("bake.glb");
  const std::string out = bench::temporary_file("baked.glb");
  if (!bench::write_shot(shot, kFrames, kFps, 0)) return state.SkipWithError("cannot build");
  std::vector<std::string> words = {RIGC_BINARY, "bake", shot, "-o", out};
  words.insert(words.end(), options.begin(), options.end());
  const double before = bench::children_seconds();
  for ([[maybe_unused]] auto iteration : state)
    if (!bench::run_process(words)) state.SkipWithError("failed");
  state.counters["cpu_ms"] = 1e3 * (bench::children_seconds() - before);
  std::filesystem::remove(shot);
  std::filesystem::remove(out);
}

}  // namespace

void rigc::bench::add_bake_benchmarks() {
  const auto add = [](const char* name, std::vector<std::string> options) {
    benchmark::RegisterBenchmark(name, bake, std::move(options))
        ->Iterations(1)
        ->Repetitions(30)
        ->ReportAggregatesOnly()
        ->ComputeStatistics("min", least)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("bake/biped_250_frames", {});
  add("bake/biped_250_frames_reduced", {"--tolerance", "0.1"});
  add("bake/biped_250_frames_keep_rig", {"--keep-rig"});
}
