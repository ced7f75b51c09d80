// SPDX-License-Identifier: MIT
// Every call of the file layer fails once, in turn: each file is the old one or the new one, the
// exit status and the message say so, and nothing is left behind.
#include <doctest/doctest.h>

#include <algorithm>
#include <cerrno>
#include <set>

#include "faults/fault_helpers.h"

using namespace rigc::test;

namespace {

const std::set<std::string> kTransfers = {"read", "pread", "write", "copy_file_range"};
const std::set<std::string> kInterruptible = {"open",  "read",  "pread", "write", "copy_file_range",
                                              "fsync", "close", "flock"};

std::string name_of_call(const std::string& call) { return call.substr(0, call.find(' ')); }

/// What can become of a call.
std::vector<std::string> kinds_of(const std::string& call) {
  std::vector<std::string> kinds = {std::to_string(EIO), std::to_string(ENOSPC)};
  if (kInterruptible.count(name_of_call(call))) kinds.push_back(std::to_string(EINTR));
  if (kTransfers.count(name_of_call(call))) kinds.push_back("short");
  return kinds;
}

void check_message(const Command& command, const Outcome& outcome) {
  INFO(outcome.err);
  CHECK(outcome.err.find(": error[RIG0") != std::string::npos);
  CHECK(outcome.err.find(command.target) != std::string::npos);
}

void fail_once(const Stage& stage, const std::string& call, int at, const std::string& kind) {
  CAPTURE(call);
  CAPTURE(kind);
  stage.reset();
  const Outcome outcome = stage.run(faulty(stage.path(), at, kind));
  CAPTURE(outcome.err);
  const Files files = stage.files();
  const bool refused = outcome.status == 3;
  CHECK((outcome.status == 0 || refused));
  if (refused) check_message(stage.command(), outcome);
  if (!refused) CHECK(files == stage.command().after);
  // Bytes that come in pieces, and signals, are no failures.
  const bool harmless = kind == "short" || kind == std::to_string(EINTR);
  if (harmless) CHECK(outcome.status == 0);
  // What cannot be removed stays, hidden.
  CHECK(damage(stage.command(), files, call.starts_with("unlink")) == "");
}

}  // namespace

TEST_CASE(
    "faults: whichever call of the file layer fails, files are the old ones or the new ones") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    const Stage stage(command);
    const auto calls = calls_of(stage);
    std::set<std::string> names;
    for (const std::string& call : calls) names.insert(name_of_call(call));
    for (const char* needed : {"open", "write", "fsync", "rename", "close"})
      CHECK(names.count(needed) == 1);
    CHECK(std::count(calls.begin(), calls.end(), "fsync " + stage.path().string()) >= 1);
    int runs = 0;
    for (std::size_t i = 0; i < calls.size(); ++i) {
      for (const std::string& kind : kinds_of(calls[i])) {
        fail_once(stage, calls[i], static_cast<int>(i) + 1, kind);
        ++runs;
      }
    }
    MESSAGE(command.name << ": " << calls.size() << " calls, " << runs << " faults");
  }
}
