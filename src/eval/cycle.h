// SPDX-License-Identifier: MIT
// Reports a cycle with every plug, command and template line in it. Test: tests/eval/cycle_test.cpp
#pragma once

#include <vector>

#include "base/diagnostics.h"
#include "scene/scene.h"

namespace rigc::eval {

/// `ring`: plugs, each of which needs the next; the last needs the first.
void report_cycle(const scene::Scene& scene, std::vector<scene::Plug> ring,
                  Diagnostics& diagnostics);

}  // namespace rigc::eval
