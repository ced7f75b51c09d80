// SPDX-License-Identifier: MIT
// The reference made from data: modules and diagnostics. Test: tests/cli/cli_test.cpp,
// tests/cli/bad_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

/// The catalogue as a list, or one module with its parameters and example.
std::optional<std::string> modules(const std::string& name, const Paths& paths, bool json,
                                   Diagnostics& diagnostics);

/// `enum: auto, forward, ...`, `float 0..1`, `node (joint)`.
std::string type_text(const catalog::Parameter& parameter);
/// `required`, the default, or nothing.
std::string default_text(const catalog::Parameter& parameter);

/// docs/modules.md: every built-in module.
std::string module_reference();
/// docs/diagnostics.md: every code of every folder.
std::string diagnostic_reference();
/// All codes, by number.
std::vector<const Code*> all_codes();

}  // namespace rigc::pipeline
