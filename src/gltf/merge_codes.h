// SPDX-License-Identifier: MIT
// Diagnostic codes 681..684, 688, 689, 695..697: several files in one, several rigs in one. Test:
// tests/gltf/merge_test.cpp, tests/pipeline/merge_into_test.cpp
#pragma once

#include "base/diagnostics.h"

namespace rigc::gltf::codes {

inline constexpr Code kMergeExtension{
    681, Severity::error, "extension cannot be merged",
    "A merge numbers elements anew. The extension is not one that rigc knows, so it may hold "
    "numbers that would then be wrong. A file that comes first keeps its numbers: if only one of "
    "the files has the extension, name that one first."};
inline constexpr Code kMergeIndex{
    682, Severity::error, "index to nowhere",
    "An extension names an element that its file does not have, or names it in an unknown way, so "
    "that it cannot be named in the merged file."};
inline constexpr Code kMergeTwice{
    683, Severity::error, "only one file can have this",
    "An extension of the root describes the whole file, and two of the files have one; or it goes "
    "by the order of the materials, and its file does not come first."};
inline constexpr Code kMergeSameGlobal{
    684, Severity::error, "two rigs with one global group",
    "Rigs in one file are told apart by their global groups. `rigc rename FILE --global old=new` "
    "gives one of them another."};
inline constexpr Code kMergeLeftOut{688, Severity::warning, "left out of the merged file",
                                    "A member of the root, or of a clip that joins another, that "
                                    "only one of them can have: that of "
                                    "the first file stays."};

// One rig of several.
inline constexpr Code kNoSuchJoin{
    689, Severity::error, "nothing to join",
    "--into names a rig by its global group, --attach a local group of another rig and a joint of "
    "the first, by local group and label: `--attach arm_l=torso.chest`."};
inline constexpr Code kNotAttached{
    695, Severity::error, "root is not attached",
    "Every root joint of a rig that joins another hangs under one of its joints: --attach names a "
    "local group below each root."};
inline constexpr Code kRigsClash{
    696, Severity::error, "rigs cannot become one",
    "Joints of one rig have different keys, its local groups different names, its shapes and "
    "modules one meaning. Two rigs of one template have the same joints; two versions of a module "
    "are made one by updating both rigs."};
inline constexpr Code kKeysOnRoot{
    697, Severity::warning, "keys on what hangs elsewhere now",
    "The clip animates a node that hung under nothing of its rig and now follows a joint: its keys "
    "count from there. Keys on controls are not concerned."};

inline constexpr const Code* kMergeCodes[] = {&kMergeExtension,  &kMergeIndex,   &kMergeTwice,
                                              &kMergeSameGlobal, &kMergeLeftOut, &kNoSuchJoin,
                                              &kNotAttached,     &kRigsClash,    &kKeysOnRoot};

}  // namespace rigc::gltf::codes
