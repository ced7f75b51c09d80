// SPDX-License-Identifier: MIT
// Whether a rig can be written, so that what was written can be read again. Test:
// tests/gltf/rig_test.cpp
#pragma once

#include "gltf/rig.h"

namespace rigc::gltf {

/// Sizes, depth, and every number: finite, and transforms within the range of 32-bit floats.
bool check_writable(const Rig& rig, Diagnostics& diagnostics);

}  // namespace rigc::gltf
