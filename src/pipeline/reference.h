// SPDX-License-Identifier: MIT
// The reference made from data: modules, diagnostics, JSON Schemas. Test:
// tests/pipeline/reference_test.cpp
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

/// JSON Schema (2020-12) of a module's `with:`, or of RIGC_rig (from the data folder).
std::optional<std::string> schema(const std::string& name, const Paths& paths,
                                  Diagnostics& diagnostics);

/// docs/modules.md: every built-in module.
std::string module_reference();
/// docs/diagnostics.md: every code of every folder.
std::string diagnostic_reference();
/// All codes, by number.
std::vector<const Code*> all_codes();

}  // namespace rigc::pipeline
