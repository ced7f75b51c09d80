// SPDX-License-Identifier: MIT
// Diagnostics of update, rebuild, unbuild, strip and prune: RIG0880 to RIG0919.
#pragma once

#include "base/diagnostics.h"

namespace rigc::pipeline::codes {

inline constexpr Code kNoRigHere{880, Severity::error, "the file has no rig",
                                 "Only files that rigc has built a rig into can be updated, "
                                 "rebuilt or taken apart."};
inline constexpr Code kWouldOrphan{
    881, Severity::error, "keys would lose their node",
    "With --strict a file is left alone where keys or values of its rig would find no node in the "
    "new version. Without it they become orphans, which a later version can take back."};
inline constexpr Code kMoves{882, Severity::error, "the rig plays differently",
                             "A joint moves by more than --tolerance allows between the old and "
                             "the new rig. The file is left alone."};
inline constexpr Code kTemplateLost{
    884, Severity::error, "template not found",
    "The template that made the rig, a part of it or a module is in none of the folders. Name "
    "their folders with --templates and --modules, or the template to follow with --to."};
inline constexpr Code kOlderOnly{
    885, Severity::warning, "only an older version is found",
    "The rig was built with a newer version of its template, of a part or of a module than there "
    "is. It is left as it is; --to NAME@VERSION goes back on purpose."};
inline constexpr Code kSettingGone{
    886, Severity::warning, "setting of the rig is gone",
    "The rig was built with a feature, switch or group turned on or off that the new version does "
    "not have. The setting is dropped."};
inline constexpr Code kModelGone{
    887, Severity::error, "the model's skeleton is not found",
    "The rig was fitted to joints of the model that no skeleton of the file has any more."};

inline constexpr Code kStaleBake{
    889, Severity::warning, "baked keys are of the old rig",
    "The file has keys on joints that `rigc bake --keep-rig` made, and joints move otherwise now. "
    "Bake it again; keys on controls are what counts."};

inline constexpr const Code* kUpdateCodes[] = {&kNoRigHere,    &kWouldOrphan, &kMoves,
                                               &kTemplateLost, &kOlderOnly,   &kSettingGone,
                                               &kModelGone,    &kStaleBake};

}  // namespace rigc::pipeline::codes
