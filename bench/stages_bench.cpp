// SPDX-License-Identifier: MIT
// Where the time of `rigc build templates/biped.yaml` goes: each repetition is one whole build
// inside this process, and each row is one stage of it.
#include <benchmark/benchmark.h>

#include <string>
#include <utility>
#include <vector>

#include "base/trace.h"
#include "bench/bench.h"
#include "pipeline/build.h"

namespace {

using namespace rigc;

/// Seconds that each stage of one build took, in order; empty where the build failed.
std::vector<std::pair<std::string, double>> time_stages() {
  pipeline::BuildRequest request;
  request.template_file = std::string(RIGC_SOURCE_DIR) + "/templates/biped.yaml";
  trace::Recorder recorder;
  {
    const trace::Attach attach(&recorder);
    Diagnostics diagnostics;
    if (!pipeline::build(request, bench::temporary_file("stages.glb"), diagnostics)) return {};
  }
  std::vector<std::pair<std::string, double>> stages;
  const std::vector<trace::ThreadEvents> threads = recorder.threads();
  for (const trace::Event& event : threads.front().events)
    if (event.depth == 0)
      stages.emplace_back(event.name, static_cast<double>(event.end - event.begin) / 1e9);
  return stages;
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
