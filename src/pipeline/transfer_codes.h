// SPDX-License-Identifier: MIT
// Diagnostic codes 784, 796 to 798: transfer. Test: tests/pipeline/transfer_test.cpp
#pragma once

#include "base/diagnostics.h"

namespace rigc::pipeline::codes {

inline constexpr Code kNoSuchLimb{
    784, Severity::error, "no such limb",
    "--limb takes a local group whose controls switch between FK and IK, and what it shall be: "
    "arm_l=ik. `all` stands for every one."};
inline constexpr Code kNotReached{
    796, Severity::warning, "controls do not reach the clip's pose",
    "A joint's place or turn cannot be said by the controls that drive it: eyes that look at a "
    "target do not roll, limits and locks hold, and rigs of earlier versions cannot twist the "
    "bones "
    "of a limb in IK, where FK can. --strict makes an error of it."};
inline constexpr Code kNotReachedStrictly{797, Severity::error,
                                          "controls do not reach the clip's pose",
                                          "As the warning; --strict was given."};
inline constexpr Code kReplacedKeys{
    798, Severity::warning, "keys on controls are replaced",
    "The clip also keys controls that its joints are transferred to. They get the pose of the "
    "joints, which is rest where a joint has no keys; what they had is gone from the clip."};
inline constexpr const Code* kTransferCodes[] = {&kNoSuchLimb, &kNotReached, &kNotReachedStrictly,
                                                 &kReplacedKeys};

}  // namespace rigc::pipeline::codes
