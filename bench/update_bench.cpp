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
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/update.h"

namespace {

using namespace rigc;
namespace fs = std::filesystem;

constexpr int kFiles = 200;
constexpr std::size_t kFrames = 217, kBytes = 3'000'000;
const std::string kTemplates = std::string(RIGC_SOURCE_DIR) + "/templates";

/// Channels on translation and rotation of every control: 217 keys each.
anim::Clip walk(const gltf::Rig& rig) {
  anim::Clip clip;
  clip.name = "walk";
  std::vector<float> times;
  for (std::size_t i = 0; i < kFrames; ++i) times.push_back(static_cast<float>(i) / 24);
  const auto shared = std::make_shared<const std::vector<float>>(std::move(times));
  for (const scene::NodeId id : rig.scene.nodes()) {
    if (rig.scene[id].kind != scene::Kind::control) continue;
    for (const anim::Path path : {anim::Path::translation, anim::Path::rotation}) {
      anim::Channel& channel = clip.channels.emplace_back();
      channel.node = rig.nodes[id.index];
      channel.path = path;
      channel.curve.times = shared;
      channel.curve.width = path == anim::Path::rotation ? 4 : 3;
      for (std::size_t i = 0; i < kFrames; ++i) {
        const double angle = 0.1 * math::sin(0.1 * static_cast<double>(i + id.index));
        const auto s = static_cast<float>(math::sin(angle));
        const auto c = static_cast<float>(math::cos(angle));
        if (path == anim::Path::rotation)
          channel.curve.values.insert(channel.curve.values.end(), {s, 0, 0, c});
        else
          channel.curve.values.insert(channel.curve.values.end(), {s, 0.1f * s, 0});
      }
    }
  }
  return clip;
}

/// A folder with `templates`, a newer biped with larger shapes, and `shot.glb`.
bool make_shot(const std::string& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = kTemplates + "/biped.yaml";
  request.paths.templates = {kTemplates};
  const std::string shot = folder + "/shot.glb";
  const auto built = pipeline::build(request, shot, diagnostics);
  const auto file = gltf::open(shot, diagnostics);
  if (!built || !file) return false;
  gltf::Patch patch(*file);
  gltf::write_clips(patch, *file, {{walk(built->rig), {}}});
  const std::uint64_t size = file->whole.size() + 2 * kFrames * 14 * 78;
  patch.append_view(std::string(size < kBytes ? kBytes - size : 0, '\0'), 0);  // the rest of a shot
  std::uint64_t bytes = 0;
  if (!pipeline::write_output(patch, *file, shot, bytes, diagnostics)) return false;
  fs::copy(kTemplates, folder + "/templates", fs::copy_options::recursive);
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
