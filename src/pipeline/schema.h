// SPDX-License-Identifier: MIT
// JSON Schemas for editors and checks, made from the tables that the readers use. Draft 7: what
// every version of yaml-language-server reads. Test: tests/pipeline/schema_test.cpp,
// tools/node/check_templates.mjs
#pragma once

#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

/// The schema of template files (`template`), maps (`map`), module descriptors (`module`), of
/// RIGC_rig (from the data folder), or of the `with:` of the module that `name` names.
std::optional<std::string> schema(const std::string& name, const Paths& paths,
                                  Diagnostics& diagnostics);

}  // namespace rigc::pipeline
