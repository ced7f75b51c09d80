// SPDX-License-Identifier: MIT
// Names that a command line may have: of templates, maps and modules, for shells that complete it.
// Test: tests/cli/completions_test.cpp
#pragma once

#include <string>
#include <vector>

#include "pipeline/environment.h"

namespace rigc::pipeline {

/// Sorted, each once. `kind`: "templates", "maps" or "modules".
std::vector<std::string> names(const std::string& kind, const Paths& paths,
                               Diagnostics& diagnostics);

}  // namespace rigc::pipeline
