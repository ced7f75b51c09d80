// SPDX-License-Identifier: MIT
// What 2 MB of JSON cost: parsed, opened (read, parsed and checked), and the whole way of a change
// through a file: open, patch, finish, write. The aim: below 10 ms. The model is made here: what
// exporters write for many skinned characters with clips.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <utility>

#include "base/json.h"
#include "bench/bench.h"
#include "gltf/patch.h"

namespace {

using namespace rigc;

constexpr std::size_t kBytes = 2'000'000;
constexpr int kJoints = 60;

/// A member of the root with the elements that `add` gives, in copies of a character.
template <class Add>
std::string array(const char* name, int copies, const Add& add) {
  std::string text = fmt::format("\"{}\":[", name);
  for (int copy = 0; copy < copies; ++copy)
    text += add(copy) + std::string(copy + 1 < copies ? "," : "");
  return text + "]";
}

std::string nodes(int copy) {
  std::string text = fmt::format(R"({{"name":"body_{}","mesh":{},"skin":{}}})", copy, copy, copy);
  const int first = copy * (kJoints + 1) + 1;
  for (int i = 0; i < kJoints; ++i) {
    const std::string children =
        i + 1 < kJoints ? fmt::format(R"(,"children":[{}])", first + i + 1) : "";
    text += fmt::format(
        R"(,{{"name":"mixamorig:Joint{}","translation":[0.{}0011920928955078125,0.1667236089706421,-0.0{}])"
        R"(,"rotation":[-0.0000030724293083039,0,0.683715820312511,0.72974]{}}})",
        i, i + 10, i, children);
  }
  return text;
}

std::string skin(int copy) {
  std::string joints;
  for (int i = 0; i < kJoints; ++i)
    joints += fmt::format("{}{}", i ? "," : "", copy * (kJoints + 1) + 1 + i);
  return fmt::format(R"({{"inverseBindMatrices":0,"joints":[{}]}})", joints);
}

std::string animation(int copy) {
  std::string channels, samplers;
  for (int i = 0; i < kJoints; ++i) {
    const char* comma = i ? "," : "";
    channels += fmt::format(R"({}{{"sampler":{},"target":{{"node":{},"path":"rotation"}}}})", comma,
                            i, copy * (kJoints + 1) + 1 + i);
    samplers += fmt::format(R"({}{{"input":1,"output":{},"interpolation":"LINEAR"}})", comma,
                            3 + copy * kJoints + i);
  }
  return fmt::format(R"({{"name":"walk {}","channels":[{}],"samplers":[{}]}})", copy, channels,
                     samplers);
}

std::string accessors(int copy) {
  std::string text;
  for (int i = 0; i < kJoints; ++i)
    text += fmt::format(
        R"({}{{"bufferView":0,"byteOffset":{},"componentType":5126,"count":2,"type":"VEC4",)"
        R"("min":[-0.9999983310699463,0,0,-1],"max":[1.000001072883606,0.6837158203125,0,1]}})",
        i ? "," : "", i * 32);
  return copy > 0 ? text
                  : R"({"bufferView":0,"componentType":5126,"count":60,"type":"MAT4"},)"
                    R"({"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},)"
                    R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)" +
                        text;
}

std::string model(int copies) {
  std::string roots;
  for (int copy = 0; copy < copies; ++copy)
    roots +=
        fmt::format("{}{},{}", copy ? "," : "", copy * (kJoints + 1), copy * (kJoints + 1) + 1);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots + "]}]," +
         array("nodes", copies, nodes) + "," + array("skins", copies, skin) + "," +
         array("animations", copies, animation) + "," + array("accessors", copies, accessors) +
         "," +
         array("meshes", copies,
               [](int) { return R"({"primitives":[{"attributes":{"POSITION":2}}]})"; }) +
         R"(,"bufferViews":[{"buffer":0,"byteLength":3840}],)"
         R"("buffers":[{"byteLength":3840}]})";
}

std::string model_of_size() {
  const std::size_t one = model(1).size();
  return model(static_cast<int>(kBytes / one) + 1);
}

void parse(benchmark::State& state) {
  const std::string text = model_of_size();
  for ([[maybe_unused]] auto iteration : state) {
    Diagnostics diagnostics;
    benchmark::DoNotOptimize(json::parse(text, "", 0, diagnostics));
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
}

/// What a rig changes: joints are marked, nodes and an extension come.
std::optional<gltf::Output> changed(const gltf::File& file, Diagnostics& diagnostics) {
  gltf::Patch patch(file);
  for (int i = 0; i < kJoints; ++i) {
    patch.set_extra(i, "rigc", "\"0:f105762e3342a3b8\"");
    patch.add_child(-1, patch.append("nodes", R"({"name":"control"})"));
  }
  patch.set_root_extension("RIGC_rig", R"({"version":1})");
  return patch.finish(false, diagnostics);
}

enum class End { opened, patched, written };

void way(benchmark::State& state, End end) {
  const std::string in = bench::temporary_file("json.gltf");
  const std::string out = bench::temporary_file("json_out.gltf");
  Diagnostics diagnostics;
  if (!write_file(in, {model_of_size()}, diagnostics)) state.SkipWithError("no model");
  for ([[maybe_unused]] auto iteration : state) {
    const auto file = gltf::open(in, diagnostics);
    if (!file || end == End::opened) continue;
    const auto output = changed(*file, diagnostics);
    if (output && end == End::written) write_file(out, output->pieces, diagnostics);
  }
  if (!diagnostics.ok()) state.SkipWithError(diagnostics.all().front().message.c_str());
}

}  // namespace

void rigc::bench::add_json_benchmarks() {
  const std::pair<const char*, End> ways[] = {{"open", End::opened},
                                              {"open_patch", End::patched},
                                              {"open_patch_write_and_flush", End::written}};
  benchmark::RegisterBenchmark("2MB_json/parse", parse)->Unit(benchmark::kMillisecond);
  for (const auto& [name, end] : ways)
    benchmark::RegisterBenchmark((std::string("2MB_json/") + name).c_str(), way, end)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}
