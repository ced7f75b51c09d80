// SPDX-License-Identifier: MIT
// Diagnostic codes 830..849: renaming rigs, and several rigs in one.
#pragma once

#include "base/diagnostics.h"

namespace rigc::pipeline::codes {

inline constexpr Code kBadPair{830, Severity::error, "not OLD=NEW",
                               "--global takes the name that a rig has and the one that it gets: "
                               "letters, digits, `_` and `-`, not starting with a digit. An old "
                               "name is given once."};
inline constexpr Code kNoSuchRig{831, Severity::error, "no such rig",
                                 "No rig of the file has this global group; `rigc inspect FILE` "
                                 "lists those that there are."};
inline constexpr Code kGlobalTaken{
    832, Severity::error, "name is taken",
    "Rigs of one file are told apart by their global groups, so each has its own."};

inline constexpr Code kBadAttach{
    833, Severity::error, "not LOCAL=LOCAL.LABEL",
    "--attach takes a local group of a rig that joins and the joint that takes it, for example "
    "arm_l=torso.chest, or prop:arm_l=torso.chest where several rigs have that group. It needs "
    "--into, the global group of the rig that the others join."};

inline constexpr const Code* kMergeFileCodes[] = {&kBadPair, &kNoSuchRig, &kGlobalTaken,
                                                  &kBadAttach};

}  // namespace rigc::pipeline::codes
