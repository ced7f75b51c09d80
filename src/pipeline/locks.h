// SPDX-License-Identifier: MIT
// Keys on what a rig has locked. Test: tests/pipeline/locks_test.cpp
#pragma once

#include <string>

#include "anim/clip.h"
#include "base/diagnostics.h"
#include "gltf/rig.h"

namespace rigc::pipeline {

/// Warns of each control whose locked attributes the clip would change: those keys have no effect.
void report_locked_keys(const std::string& file, const gltf::Rig& rig, const anim::Clip& clip,
                        Diagnostics& diagnostics);

}  // namespace rigc::pipeline
