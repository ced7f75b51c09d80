// SPDX-License-Identifier: MIT
// The terminal. Test: tests/cli/cli_test.cpp
#include "cli/terminal.h"

#include <unistd.h>

#include <cstdlib>

namespace rigc::cli {

bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return ::isatty(STDERR_FILENO) != 0 && !(no_colour && *no_colour);
}

}  // namespace rigc::cli
