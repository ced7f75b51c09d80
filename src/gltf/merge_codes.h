// SPDX-License-Identifier: MIT
// Diagnostic codes 681..684, 688: several files in one. Test: tests/gltf/merge_test.cpp
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
inline constexpr Code kMergeLeftOut{
    688, Severity::warning, "left out of the merged file",
    "A member of the root that only one file can have: that of the first file stays."};

inline constexpr const Code* kMergeCodes[] = {&kMergeExtension, &kMergeIndex, &kMergeTwice,
                                              &kMergeSameGlobal, &kMergeLeftOut};

}  // namespace rigc::gltf::codes
