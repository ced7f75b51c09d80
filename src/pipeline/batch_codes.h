// SPDX-License-Identifier: MIT
// Diagnostic codes 810..829: what concerns many files at once.
#pragma once

#include "base/diagnostics.h"

namespace rigc::pipeline::codes {

inline constexpr Code kNoInputs{
    810, Severity::error, "no files found",
    "A folder is searched for .glb, .gltf and .vrm files, a pattern ('shots/**/a*.glb', in quotes) "
    "names such files, @LIST is a text file with one path per line. Hidden files are left out."};
inline constexpr Code kSameOutput{
    811, Severity::error, "one output for several files",
    "What one file becomes would replace another. Files that are named one by one go into "
    "--out-dir and --backup under their own names alone: name the folder that they lie in, or a "
    "pattern in quotes, so that the tree is mirrored."};
inline constexpr Code kNotThatReport{812, Severity::error, "report of other work",
                                     "--resume goes on with the work that wrote the report: the "
                                     "same command with the same options."};
inline constexpr Code kInterrupted{
    813, Severity::error, "interrupted",
    "The files that were begun were finished; the others are as they were. --resume with the "
    "report of this run goes on."};
inline constexpr Code kBadOptions{814, Severity::error, "options that do not go together",
                                  "`rigc COMMAND --help` says what each option is for."};
inline constexpr Code kOutOfMemory{
    815, Severity::error, "memory exhausted",
    "The file needs more memory than there is; nothing was written. A smaller --jobs leaves more "
    "for each file."};

inline constexpr const Code* kBatchCodes[] = {&kNoInputs,    &kSameOutput, &kNotThatReport,
                                              &kInterrupted, &kBadOptions, &kOutOfMemory};

}  // namespace rigc::pipeline::codes
