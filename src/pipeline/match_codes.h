// SPDX-License-Identifier: MIT
// Diagnostic codes 840 to 845: match. Test: tests/cli/match_test.cpp
#pragma once

#include "base/diagnostics.h"

namespace rigc::pipeline::codes {

inline constexpr Code kNoMatchLimb{
    840, Severity::error, "no limb to match",
    "--limb takes the local group of a limb that `ik_fk_limb` made, such as arm_l, or `all`. Rigs "
    "of earlier versions do not say which controls belong together: rebuild them."};
inline constexpr Code kMatchRequest{841, Severity::error, "no such match",
                                    "--to takes ik or fk, --range two times in seconds: 0.5:2; "
                                    "--space goes with --control, in place of --to and --limb."};
inline constexpr Code kNotMatched{
    842, Severity::warning, "controls do not reach the limb's pose",
    "The other side cannot hold the pose: a limit or a lock is in the way, or the limb's lengths "
    "were changed and there is no attribute that says so. `limb_stretch` adds one."};
inline constexpr Code kNoMatchSpace{
    843, Severity::error, "no such space",
    "--control takes one control, by its node's name or a selector, and --space one of those that "
    "`space_switch` lets it follow. Rigs of earlier versions do not say which these are: rebuild "
    "them."};
inline constexpr Code kNothingToMatch{
    844, Severity::error, "the clip keys no control",
    "A clip of joints alone has no keys to match: with some, a bake would make all of its joints "
    "again, from controls that rest. `rigc transfer` gives its motion to the controls."};
inline constexpr Code kRangeClipped{
    845, Severity::warning, "range reaches beyond the clip",
    "A match does not make clips longer: what of --range lies in the clip is matched."};
inline constexpr const Code* kMatchCodes[] = {&kNoMatchLimb,  &kMatchRequest,   &kNotMatched,
                                              &kNoMatchSpace, &kNothingToMatch, &kRangeClipped};

}  // namespace rigc::pipeline::codes
