// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM as a flag, for commands that finish what they have begun.
// Test: tests/faults/interruption_test.cpp
#pragma once

#include <atomic>

namespace rigc::cli {

/// From now on the first SIGINT or SIGTERM sets the flag; the second ends the process, as always.
/// A signal that the process was started to ignore stays ignored.
const std::atomic<bool>& watch_for_interruption();

}  // namespace rigc::cli
