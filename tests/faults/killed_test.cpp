// SPDX-License-Identifier: MIT
// Processes that are killed, at each call of the file layer and at random moments: every file is
// the old one or the new one, and the command can be run again.
#include <doctest/doctest.h>

#include <chrono>
#include <random>

#include "faults/fault_helpers.h"

using namespace rigc::test;

namespace {

/// How long a command takes, microseconds.
unsigned duration(const Stage& stage) {
  using Clock = std::chrono::steady_clock;
  stage.reset();
  const auto begun = Clock::now();
  CHECK(stage.run().status == 0);
  return static_cast<unsigned>(
      std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begun).count());
}

}  // namespace

TEST_CASE("faults: killed at any call of the file layer") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    const Stage stage(command);
    const auto calls = calls_of(stage);
    for (std::size_t i = 0; i < calls.size(); ++i) {
      CAPTURE(calls[i]);
      stage.reset();
      CHECK(stage.run(faulty(stage.path(), static_cast<int>(i) + 1, "kill")).status == 128 + 9);
      CHECK(damage(command, stage.files(), true) == "");
    }
  }
}

TEST_CASE("faults: killed at random moments") {
  const int times = count_from_environment("RIGC_FAULT_KILLS", 100);
  std::mt19937 random(4);
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    const Stage stage(command);
    const unsigned whole = duration(stage);
    int killed = 0, untouched = 0;
    for (int i = 0; i < times; ++i) {
      stage.reset();
      killed += stage.run_and_kill(static_cast<unsigned>(random() % (whole + whole / 8))) ? 1 : 0;
      const Files files = stage.files();
      CHECK(damage(command, files, true) == "");
      untouched += files == command.before ? 1 : 0;
    }
    MESSAGE(command.name << ": " << killed << " of " << times << " killed, " << untouched
                         << " before anything was written");
    CHECK(killed > 0);
  }
}
