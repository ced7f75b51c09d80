// SPDX-License-Identifier: MIT
// Diagnostic codes 560..599: compiling a scene.
// Test: every code is provoked in tests/eval/compile_test.cpp.
#pragma once

#include "base/diagnostics.h"

namespace rigc::eval::codes {

inline constexpr Code kCycle{
    560, Severity::error, "cycle of connections",
    "Attributes depend on each other in a ring, so that none can be computed first. The hint lists "
    "them all with what made their nodes; take one of these connections away."};
inline constexpr Code kBadNode{
    561, Severity::error, "node cannot be evaluated",
    "The data of a solver, constraint or curve do not fit together; the message says what. Modules "
    "never build such nodes: the file was written by something else, or is damaged."};
inline constexpr Code kBadRequest{562, Severity::error, "attribute cannot be evaluated",
                                  "Only numbers, vectors, rotations and matrices are evaluated, "
                                  "and only inputs that are numbers, "
                                  "vectors or rotations can vary from frame to frame."};

inline constexpr const Code* kEvalCodes[] = {&kCycle, &kBadNode, &kBadRequest};

}  // namespace rigc::eval::codes
