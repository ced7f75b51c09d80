// SPDX-License-Identifier: MIT
// Status over a thousand shots of 3 MB with 0.7 MB of JSON, and finding the templates that come
// with rigc. The aims: a thousand files a second, and 3 ms.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "bench/bench.h"
#include "pipeline/build.h"
#include "pipeline/status.h"
#include "templates/versions.h"

namespace {

using namespace rigc;
namespace fs = std::filesystem;

constexpr int kFiles = 1000, kDistinct = 8;
constexpr std::size_t kBytes = 3'000'000, kJson = 700'000;
const std::string kTemplates = std::string(RIGC_SOURCE_DIR) + "/templates";

std::string little_endian(std::size_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  return bytes;
}

/// A .gltf text as a .glb of a shot's size: accessors like those of keys, and zeros.
std::string padded(std::string json) {
  while (json.size() < kJson) {
    const std::string accessor =
        R"({"bufferView":0,"componentType":5126,"count":12,"type":"SCALAR","min":[0.0]},)";
    std::string many;
    while (many.size() < kJson - json.size()) many += accessor;
    many.back() = ']';
    json.insert(1, "\"keys\":[" + many + ",");
  }
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::string bin(kBytes - json.size(), '\0');
  return "glTF" + little_endian(2) + little_endian(28 + json.size() + bin.size()) +
         little_endian(json.size()) + "JSON" + json + little_endian(bin.size()) +
         std::string("BIN\0", 4) + bin;
}

bool make_shots(const std::string& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = kTemplates + "/biped.yaml";
  request.paths.templates = {kTemplates};
  const std::string rig = folder + "/rig.gltf";
  if (!pipeline::build(request, rig, diagnostics)) return false;
  std::ostringstream json;
  json << std::ifstream(rig, std::ios::binary).rdbuf();
  const std::string text = padded(json.str());
  fs::create_directories(folder + "/shots");
  const auto name = [&](int i) { return folder + "/shots/" + std::to_string(1000 + i) + ".glb"; };
  for (int i = 0; i < kDistinct; ++i) std::ofstream(name(i), std::ios::binary) << text;
  for (int i = kDistinct; i < kFiles; ++i) fs::create_hard_link(name(i % kDistinct), name(i));
  return true;
}

void status(benchmark::State& state) {
  const std::string folder = bench::temporary_file("status");
  if (!make_shots(folder)) state.SkipWithError("cannot build");
  pipeline::StatusRequest request;
  request.inputs = {folder + "/shots"};
  request.jobs = 2;
  request.paths.templates = {kTemplates};
  for ([[maybe_unused]] auto iteration : state) {
    Diagnostics diagnostics;
    const auto files = pipeline::status(request, diagnostics);
    if (!files || files->size() != kFiles || any_changes(*files)) state.SkipWithError("wrong");
  }
  state.SetItemsProcessed(state.iterations() * kFiles);
  fs::remove_all(folder);
}

void find_templates(benchmark::State& state) {
  for ([[maybe_unused]] auto iteration : state)
    benchmark::DoNotOptimize(templates::Versions({kTemplates}));
}

}  // namespace

void rigc::bench::add_status_benchmarks() {
  const auto add = [](const char* name, auto what) {
    benchmark::RegisterBenchmark(name, what)
        ->Repetitions(5)
        ->ReportAggregatesOnly()
        ->ComputeStatistics("min", least)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("status/1000x3MB", status);
  add("status/find_templates", find_templates);
}
