// SPDX-License-Identifier: MIT
// How far a rig is from what it shall play, at keys and between them, for people and programs.
// Test: tests/cli/transfer_test.cpp, tests/cli/match_test.cpp
#pragma once

#include <string>

#include "base/json.h"
#include "pipeline/transfer.h"

namespace rigc::cli {

/// Two lines, or one where there is one frame alone.
std::string off_as_text(const std::string& indent, std::size_t frames, const pipeline::Off& at_keys,
                        const pipeline::Off& between);

/// How many frames, and of these how many that the clip had no keys at.
std::string frames_as_text(std::size_t frames, std::size_t inserted);

/// Members `at_keys` and `between_keys` of an object.
void write_off(json::Writer& w, const pipeline::Off& at_keys, const pipeline::Off& between);

}  // namespace rigc::cli
