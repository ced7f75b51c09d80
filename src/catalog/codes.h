// SPDX-License-Identifier: MIT
// Diagnostic codes 100..149: descriptors of modules (100..124) and shapes (125..149).
// Test: every code is provoked by a test in tests/catalog.
#pragma once

#include "base/diagnostics.h"

namespace rigc::catalog::codes {

// Descriptors.
inline constexpr Code kMissingKey{100, Severity::error, "descriptor lacks a key",
                                  "Readers of the catalogue need the key: editors, the reference "
                                  "and the checks are made from it."};
inline constexpr Code kUnknownWord{101, Severity::error, "unknown word in a descriptor",
                                   "The key takes one of a few words. The hint lists them."};
inline constexpr Code kBadVersion{
    102, Severity::error, "bad version of a module",
    "Versions of modules are whole numbers from 1; every change of meaning raises them."};
inline constexpr Code kWrongFileName{
    103, Severity::error, "file is not named like its module",
    "The descriptor of module `x` is `x.yaml`, so that it is found by its name."};
inline constexpr Code kDuplicateModule{
    104, Severity::error, "module exists already",
    "Two descriptors declare a module of one name. Rename the one that was added."};
inline constexpr Code kDuplicateParameter{
    105, Severity::error, "parameter is declared twice",
    "A command gives arguments by name, so every parameter has a name of its own."};
inline constexpr Code kReservedParameter{106, Severity::error, "parameter has a reserved name",
                                         "Every command that makes nodes takes `name`, `local` and "
                                         "`label` for what it makes; a descriptor "
                                         "cannot declare them again."};
inline constexpr Code kDuplicateFrame{
    107, Severity::error, "frame is opened twice",
    "A frame is a heading in an editor. Put its parameters together under one."};
inline constexpr Code kPresence{
    108, Severity::error, "unclear whether a parameter may be left out",
    "A parameter has exactly one of `required: true`, `default: ...` and `optional: true`."};
inline constexpr Code kWrongKeyForType{
    109, Severity::error, "key does not suit the type",
    "`min` and `max` are for numbers, `values` for enums, `kind` for nodes, `unit` and `side` for "
    "quantities."};
inline constexpr Code kBadRange{110, Severity::error, "min is above max",
                                "No value lies in the range. Exchange the two or correct one."};
inline constexpr Code kBadValues{
    111, Severity::error, "bad values of an enum",
    "An enum lists at least two different words; `on`, `off`, `true`, `false` and numbers are not "
    "words."};
inline constexpr Code kBadDefault{
    112, Severity::error, "default does not fit its parameter",
    "A default must be an argument that a command could give: of the type, in the range."};
inline constexpr Code kDuplicateCreates{
    113, Severity::error, "role is declared twice",
    "Each kind of node that a module makes in a role stands once under `creates`."};
inline constexpr Code kBadReplaces{114, Severity::error, "replacement names no role of the module",
                                   "`replaces` maps roles of an earlier module to roles under "
                                   "`creates`, so that keys move along."};
inline constexpr Code kBadChange{115, Severity::error, "bad entry under changes",
                                 "A change belongs to a version from 2 to the module's own and "
                                 "names a parameter that it has now."};

inline constexpr Code kBadConversion{
    131, Severity::error, "values cannot be converted like this",
    "`factor` (not 0) and `offset` are for numbers, vectors and expressions, `min_was` and "
    "`max_was` for parameters that have a range."};
inline constexpr Code kSameEarlierName{
    132, Severity::error, "two have had one earlier name",
    "Two changes say of two parameters, or of two attributes, that they had the same name in the "
    "same version. A value under that name would belong to both."};

// Shapes.
inline constexpr Code kEmptyShape{
    125, Severity::error, "shape has no lines",
    "A shape has at least one of `lines`, `curves` and `circles`, each line at least two points."};
inline constexpr Code kDuplicateShape{126, Severity::error, "shape exists already",
                                      "Two shapes have one name. Rename one of them."};
inline constexpr Code kBadPoint{
    127, Severity::error, "bad point of a shape",
    "A point is [x, z] in the plane or [x, y, z], with coordinates between -1000 and 1000."};
inline constexpr Code kBadCircle{128, Severity::error, "bad circle of a shape",
                                 "A circle has a radius above 0, 3 to 128 segments, and an arc "
                                 "from `from` to `to` of at most 360 "
                                 "degrees."};
inline constexpr Code kBadRepeat{
    129, Severity::error, "bad repeat of a shape",
    "`repeat` is a whole number from 2 to 64: how often lines are repeated around the Y axis."};
inline constexpr Code kLargeShape{
    130, Severity::error, "shape has too many points",
    "A shape has at most 4096 points: every control that uses it stores and draws them."};

inline constexpr const Code* kCatalogCodes[] = {
    &kMissingKey,      &kUnknownWord,        &kBadVersion,        &kWrongFileName,
    &kDuplicateModule, &kDuplicateParameter, &kReservedParameter, &kDuplicateFrame,
    &kPresence,        &kWrongKeyForType,    &kBadRange,          &kBadValues,
    &kBadDefault,      &kDuplicateCreates,   &kBadReplaces,       &kBadChange,
    &kBadConversion,   &kSameEarlierName,    &kEmptyShape,        &kDuplicateShape,
    &kBadPoint,        &kBadCircle,          &kBadRepeat,         &kLargeShape};

}  // namespace rigc::catalog::codes
