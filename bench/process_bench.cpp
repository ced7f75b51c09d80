// SPDX-License-Identifier: MIT
// Whole processes, as a user waits for them: start, work, end. The aims: --version below 3 ms,
// build of the biped below 25 ms, with all features below 40 ms.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bench/bench.h"

namespace {

const std::string kSource = RIGC_SOURCE_DIR;

void process(benchmark::State& state, const std::vector<std::string>& words) {
  for ([[maybe_unused]] auto iteration : state) {
    if (!rigc::bench::run_process(words)) state.SkipWithError("rigc failed");
  }
}

void add(const std::string& name, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), RIGC_BINARY);
  benchmark::RegisterBenchmark(("process/" + name).c_str(), process, arguments)
      ->Iterations(1)
      ->Repetitions(100)
      ->ReportAggregatesOnly()
      ->ComputeStatistics("min", rigc::bench::least)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

bool rigc::bench::run_process(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = -1;
  return failed == 0 && waitpid(child, &status, 0) == child && status == 0;
}

double rigc::bench::children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string rigc::bench::corpus_file(const std::string& path) {
  const std::string file = kSource + "/../shared/corpus/" + path;
  return std::filesystem::exists(file) ? file : std::string();
}

std::string rigc::bench::temporary_file(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("rigc_bench_" + name)).string();
}

std::vector<std::string> rigc::bench::all_features() {
  return {"spine_fk=off",   "spine_ik=on", "stretch=on",   "twist=on",  "ribbons=on",
          "vector_foot=on", "auto_hip=on", "auto_pole=on", "gimbal=on", "fingertips=on"};
}

void rigc::bench::add_process_benchmarks() {
  const std::string out = temporary_file("out.glb");
  const std::string biped = kSource + "/templates/biped.yaml";
  const std::string xbot = corpus_file("mixamo_Xbot_blender/Xbot.glb");
  add("version", {"--version"});
  add("check_biped", {"check", biped});
  add("build_biped", {"build", biped, "-o", out});
  std::vector<std::string> all{"build", biped, "-o", out};
  for (const std::string& feature : all_features()) all.insert(all.end(), {"--feature", feature});
  add("build_biped_all", all);
  if (!xbot.empty()) add("build_biped_on_xbot", {"build", biped, "--model", xbot, "-o", out});
}
