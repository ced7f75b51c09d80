// SPDX-License-Identifier: MIT
// Signals. Test: tests/faults/interruption_test.cpp
#include "cli/interruption.h"

#include <signal.h>

namespace rigc::cli {
namespace {

/// A signal handler can reach nothing but globals.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr int kSignals[] = {SIGINT, SIGTERM};

void interrupt(int) {
  interrupted = true;
  for (int number : kSignals) ::signal(number, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& watch_for_interruption() {
  for (int number : kSignals) {
    struct sigaction action {
    }, before{};
    action.sa_handler = interrupt;
    action.sa_flags = SA_RESTART;
    ::sigemptyset(&action.sa_mask);
    if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(number, &action, nullptr);
  }
  return interrupted;
}

}  // namespace rigc::cli
