// SPDX-License-Identifier: MIT
// Diagnostic codes 600..629: baking. Test: every code is provoked in tests/bake.
#pragma once

#include "base/diagnostics.h"

namespace rigc::bake::codes {

inline constexpr Code kRange{
    600, Severity::error, "bad range of time",
    "Times of a bake are seconds from 0 on, and the start does not lie after the end."};
inline constexpr Code kTooLong{601, Severity::error, "bake is too long",
                               "The range has too many frames for the memory that a bake may use. "
                               "Bake it in parts, or at a lower rate."};
inline constexpr Code kNotFinite{602, Severity::error, "motion is not finite",
                                 "A joint's transform becomes infinite or too large for the 32-bit "
                                 "numbers of glTF. Look at the keys "
                                 "of scales and of attributes that drive it."};

inline constexpr const Code* kBakeCodes[] = {&kRange, &kTooLong, &kNotFinite};

}  // namespace rigc::bake::codes
