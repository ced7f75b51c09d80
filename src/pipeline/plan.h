// SPDX-License-Identifier: MIT
// Plan: the ordered command list with what its selectors resolve to. Test:
// tests/cli/cli_test.cpp
#pragma once

#include <optional>
#include <string>

#include "pipeline/build.h"

namespace rigc::pipeline {

enum class PlanForm { text, json, dot };

/// The list as text; a command that fails ends it with its diagnostics.
std::optional<std::string> plan(const BuildRequest& request, PlanForm form,
                                Diagnostics& diagnostics);

/// The program that plays the rig of a template, built in memory, or each rig of a file, where the
/// request names a .glb, .gltf or .vrm: everything that animators may key moves, the worlds of
/// joints come out. Each instruction with its registers, its node and the template line of that
/// node's command.
std::optional<std::string> plan_program(const BuildRequest& request, PlanForm form,
                                        Diagnostics& diagnostics);

}  // namespace rigc::pipeline
