// SPDX-License-Identifier: MIT
// Diagnostic codes 200..219: tags and settings.
#pragma once

#include "base/diagnostics.h"

namespace rigc::tags::codes {

inline constexpr Code kBadSetting{
    200, Severity::error, "setting cannot be read",
    "A feature setting is [GROUP/]NAME[:SWITCH]=on or =off, a group setting GROUP=on or =off. "
    "Options that take on or off take nothing else."};
inline constexpr Code kUnknownFeature{201, Severity::error, "no such feature in the template",
                                      "A setting names a feature that no tag of the template has, "
                                      "or not in that group. Names are those of "
                                      "the template's `features:`."};
inline constexpr Code kUnknownSwitch{
    202, Severity::error, "the feature has no such switch",
    "A setting names a switch that no tag of that feature has, or not in that group."};
inline constexpr Code kUnknownGroup{203, Severity::error, "no such local group in the template",
                                    "A setting names a local group that no joint has. Groups of a "
                                    "part carry the part's name: `arm_l`."};

inline constexpr const Code* kTagsCodes[] = {&kBadSetting, &kUnknownFeature, &kUnknownSwitch,
                                             &kUnknownGroup};

}  // namespace rigc::tags::codes
