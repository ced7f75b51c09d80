// SPDX-License-Identifier: MIT
// --trace and --time, for commands that do a lot. Test: tests/cli/trace_test.cpp
#pragma once

#include <functional>
#include <string>

#include "cli/command.h"

namespace rigc::cli {

struct Timing {
  std::string trace;   ///< file to write; empty: none
  bool table = false;  ///< say on stderr where the time went
};

void declare_timing(Options& options, Timing& timing);

/// Runs `work`, measured where that is asked for. A trace file that cannot be written is an error
/// before the work begins; it is also written where the work then fails. `others`: further files
/// that the command writes.
void run_timed(const Timing& timing, Session& session, const std::function<void()>& work,
               const std::vector<std::string>& others = {});

}  // namespace rigc::cli
