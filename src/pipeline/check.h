// SPDX-License-Identifier: MIT
// Check: every diagnostic of templates and rig files, nothing written. Test:
// tests/pipeline/check_test.cpp
#pragma once

#include <string>

#include "base/diagnostics.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

/// A template is read, expanded, listed and (but for parts that need groups of an outer template)
/// run; a glTF file is read with its rigs and clips, and compiled.
bool check(const std::string& file, const Paths& paths, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
