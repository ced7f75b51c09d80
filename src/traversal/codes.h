// SPDX-License-Identifier: MIT
// Diagnostic codes 420..459: resolving selectors.
#pragma once

#include "base/diagnostics.h"

namespace rigc::traversal::codes {

inline constexpr Code kNothingFound{420, Severity::error, "selector finds nothing",
                                    "No node of the rig answers to the selector when the command "
                                    "runs. The hint says which part fails, "
                                    "or which later command would make the node."};
inline constexpr Code kSeveralFound{
    421, Severity::error, "selector finds several nodes",
    "The parameter takes exactly one node. Narrow the selector by a label, a role or an index."};
inline constexpr Code kWrongKind{422, Severity::error, "selector finds a node of the wrong kind",
                                 "The parameter takes nodes of one kind only, for example joints."};
inline constexpr Code kNoAttribute{423, Severity::error, "node has no such attribute",
                                   "The selector names an attribute that the node does not have."};
inline constexpr Code kNotANumber{424, Severity::error, "plug does not carry what is needed",
                                  "The plug's type does not fit: expressions and remaps need "
                                  "numbers; name a component such as `.x`."};
inline constexpr Code kIndexOutside{
    425, Severity::error, "index outside the list",
    "The selector's index lies outside the list of what it selects from."};
inline constexpr Code kAbsentRig{426, Severity::warning, "other rig is absent",
                                 "The selector names another rig that is not in the file. The "
                                 "default is used until it is there."};

inline constexpr const Code* kTraversalCodes[] = {&kNothingFound, &kSeveralFound, &kWrongKind,
                                                  &kNoAttribute,  &kNotANumber,   &kIndexOutside,
                                                  &kAbsentRig};

}  // namespace rigc::traversal::codes
