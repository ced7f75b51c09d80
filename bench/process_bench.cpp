// SPDX-License-Identifier: MIT
// Whole processes, as a user waits for them: start, work, end. Each repetition is one process; what
// counts is the minimum and the median. The aims: --version below 3 ms, build of the biped below 25
// ms.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bench/bench.h"

namespace {

const std::string kSource = RIGC_SOURCE_DIR;

/// True where the program ended with status 0.
bool run(std::vector<std::string> words) {
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

void process(benchmark::State& state, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {RIGC_BINARY};
  words.insert(words.end(), arguments.begin(), arguments.end());
  for ([[maybe_unused]] auto iteration : state) {
    if (!run(words)) state.SkipWithError("rigc failed");
  }
}

void add(const std::string& name, const std::vector<std::string>& arguments) {
  benchmark::RegisterBenchmark(("process/" + name).c_str(), process, arguments)
      ->Iterations(1)
      ->Repetitions(100)
      ->ReportAggregatesOnly()
      ->ComputeStatistics("min", rigc::bench::least)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void rigc::bench::add_process_benchmarks() {
  const std::string out = (std::filesystem::temp_directory_path() / "rigc_bench.glb").string();
  const std::string biped = kSource + "/templates/biped.yaml";
  const std::string xbot = kSource + "/../shared/corpus/mixamo_Xbot_blender/Xbot.glb";
  add("version", {"--version"});
  add("check_biped", {"check", biped});
  add("build_biped", {"build", biped, "-o", out});
  if (std::filesystem::exists(xbot)) {
    add("build_biped_on_xbot", {"build", biped, "--model", xbot, "-o", out});
  }
}
