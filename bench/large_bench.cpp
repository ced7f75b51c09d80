// SPDX-License-Identifier: MIT
// A .glb of 250 MB gets a rig: beside it the time that cp takes for the same file, and cp with
// sync, because rigc flushes what it writes and cp alone does not. The aim: at most 1.5 times cp
// and 30 ms.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench.h"
#include "gltf/patch.h"

namespace {

using namespace rigc;

constexpr std::size_t kBytes = std::size_t{250} << 20;

/// A character with one more buffer view, of bytes without a pattern; false where that failed.
bool make_large(const std::string& character, const std::string& out) {
  Diagnostics diagnostics;
  const auto file = gltf::open(character, diagnostics);
  if (!file) return false;
  std::string noise(kBytes, '\0');
  std::uint64_t state = 1;
  for (std::size_t i = 0; i + 8 <= noise.size(); i += 8) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    noise.replace(i, 8, reinterpret_cast<const char*>(&state), 8);
  }
  gltf::Patch patch(*file);
  patch.append_view(noise, 0);
  const auto output = patch.finish(true, diagnostics);
  return output && write_file(out, output->pieces, diagnostics);
}

const std::string kLarge = bench::temporary_file("250MB.glb");
const std::string kOut = bench::temporary_file("250MB_out.glb");

/// Each run begins without its output and with nothing that still must go to the disk.
void run(benchmark::State& state, const std::vector<std::string>& words) {
  const std::string character = bench::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  static const bool made = make_large(character, kLarge);
  for ([[maybe_unused]] auto iteration : state) {
    std::filesystem::remove(kOut);
    ::sync();
    const auto begin = std::chrono::steady_clock::now();
    const bool good = made && bench::run_process(words);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    state.SetIterationTime(time.count());
    if (!good) state.SkipWithError("the program failed");
  }
}

}  // namespace

void rigc::bench::add_large_benchmarks() {
  if (corpus_file("mixamo_Xbot_blender/Xbot.glb").empty()) return;
  const std::string biped = std::string(RIGC_SOURCE_DIR) + "/templates/biped.yaml";
  const std::string copy = "cp " + kLarge + " " + kOut;
  const std::pair<const char*, std::vector<std::string>> rows[] = {
      {"cp", {"/bin/sh", "-c", copy}},
      {"cp_and_sync", {"/bin/sh", "-c", copy + " && sync " + kOut}},
      {"build_biped", {RIGC_BINARY, "build", biped, "--model", kLarge, "-o", kOut}}};
  for (const auto& [name, words] : rows) {
    benchmark::RegisterBenchmark((std::string("250MB/") + name).c_str(), run, words)
        ->Iterations(1)
        ->Repetitions(15)
        ->ReportAggregatesOnly()
        ->ComputeStatistics("min", rigc::bench::least)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  }
}
