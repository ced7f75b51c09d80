// SPDX-License-Identifier: MIT
// What is known of the terminal. Test: tests/cli/cli_test.cpp
#pragma once

namespace rigc::cli {

/// stderr is a terminal and NO_COLOR does not forbid it.
bool wants_colour();

}  // namespace rigc::cli
