// SPDX-License-Identifier: MIT
// Inspect and query: what is in a rig file. Test: tests/pipeline/inspect_test.cpp
#pragma once

#include <optional>
#include <string>

#include "base/diagnostics.h"

namespace rigc::pipeline {

/// JSON as docs/commands.md gives it, or a summary for people.
std::optional<std::string> inspect(const std::string& file, bool json, Diagnostics& diagnostics);

/// What a selector resolves to in a file; `global:` chooses among several rigs.
std::optional<std::string> query(const std::string& file, const std::string& selector, bool json,
                                 Diagnostics& diagnostics);

}  // namespace rigc::pipeline
