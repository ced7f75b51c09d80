// SPDX-License-Identifier: MIT
// Plan: the ordered command list with what its selectors resolve to. Test:
// tests/pipeline/plan_test.cpp
#pragma once

#include <optional>
#include <string>

#include "pipeline/build.h"

namespace rigc::pipeline {

enum class PlanForm { text, json, dot };

/// The list as text; a command that fails ends it with its diagnostics.
std::optional<std::string> plan(const BuildRequest& request, PlanForm form,
                                Diagnostics& diagnostics);

}  // namespace rigc::pipeline
