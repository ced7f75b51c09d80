// SPDX-License-Identifier: MIT
// Diagnostic codes 500..539: the command list and its execution.
#pragma once

#include "base/diagnostics.h"

namespace rigc::processor::codes {

inline constexpr Code kNotBuiltIn{500, Severity::error, "module has no implementation",
                                  "A descriptor names a module that this rigc does not contain. "
                                  "Descriptors alone describe; built-in modules do the work."};
inline constexpr Code kNoSuchCommand{
    501, Severity::error, "no such command",
    "`--until` takes JOINT/COMMAND: the joint's name or group.label and the command's id."};
inline constexpr Code kNoSuchGroup{502, Severity::error, "no such group",
                                   "`--only` takes the name of a local group of the template."};
inline constexpr Code kSkipped{
    503, Severity::warning, "command skipped",
    "A required selector that ends in `?` found nothing, so the command did not run."};

inline constexpr Code kIdleFeatures{
    505, Severity::warning, "feature without what it works on",
    "A feature that is on works on what the commands of another one make, and that one was turned "
    "off: its commands did not run. Turn it off as well, or leave it as it is for later."};

inline constexpr Code kDoesNotFit{
    504, Severity::error, "descriptor does not fit its implementation",
    "A descriptor whose `implementation` is another module declares that module's required "
    "parameters, and parameters that both have with the same type."};

inline constexpr const Code* kProcessorCodes[] = {&kNotBuiltIn, &kNoSuchCommand, &kNoSuchGroup,
                                                  &kSkipped,    &kIdleFeatures,  &kDoesNotFit};

}  // namespace rigc::processor::codes
