// SPDX-License-Identifier: MIT
// Where the time of `rigc build templates/biped.yaml` goes: each repetition is one whole build
// inside this process, and each row is one stage of it.
#include <benchmark/benchmark.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench.h"
#include "pipeline/build.h"

namespace {

using Clock = std::chrono::steady_clock;

/// Seconds that each stage of one build took, in order; empty where the build failed.
std::vector<std::pair<std::string, double>> time_stages() {
  std::vector<std::pair<std::string, double>> stages;
  rigc::pipeline::BuildRequest request;
  request.template_file = std::string(RIGC_SOURCE_DIR) + "/templates/biped.yaml";
  Clock::time_point last = Clock::now();
  request.on_stage = [&](std::string_view stage) {
    const Clock::time_point now = Clock::now();
    stages.emplace_back(stage, std::chrono::duration<double>(now - last).count());
    last = now;
  };
  const std::string out = rigc::bench::temporary_file("stages.glb");
  rigc::Diagnostics diagnostics;
  return rigc::pipeline::build(request, out, diagnostics)
             ? stages
             : std::vector<std::pair<std::string, double>>();
}

void stage(benchmark::State& state, std::size_t index) {
  for ([[maybe_unused]] auto iteration : state) {
    const auto stages = time_stages();
    if (index < stages.size()) {
      state.SetIterationTime(stages[index].second);
    } else {
      state.SkipWithError("the build failed");
    }
  }
}

}  // namespace

void rigc::bench::add_stage_benchmarks() {
  const auto stages = time_stages();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    benchmark::RegisterBenchmark(("build_biped/" + stages[i].first).c_str(), stage, i)
        ->Iterations(1)
        ->Repetitions(50)
        ->ReportAggregatesOnly()
        ->ComputeStatistics("min", rigc::bench::least)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}
