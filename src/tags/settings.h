// SPDX-License-Identifier: MIT
// Settings: features, switches and groups that a build turns on or off, read from the command
// line's texts and laid over a skeleton's tags. Test: tests/tags/settings_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostics.h"
#include "tags/tags.h"

namespace rigc::tags {

/// `[GROUP/]NAME[:SWITCH]=on|off`
std::optional<Settings::Feature> parse_feature_setting(std::string_view text,
                                                       Diagnostics& diagnostics);

/// `GROUP=on|off`
std::optional<std::pair<std::string, bool>> parse_group_setting(std::string_view text,
                                                                Diagnostics& diagnostics);
/// `on` or `off`, as an option takes it.
std::optional<bool> parse_switch(std::string_view option, std::string_view text,
                                 Diagnostics& diagnostics);

/// Sets `on` of features and commands. A feature tag is on when its feature and its switch are; the
/// last setting that names it counts; one for a group counts for those that were made beneath it
/// too, and before one for a wider group or for all, whatever their order. Where no setting names a
/// feature itself, turning one of its switches on turns that part of it on. Commands on joints of a
/// group that is off become off. Names that the skeleton does not have are errors; the skeleton is
/// changed only without errors.
bool apply(TaggedSkeleton& skeleton, const Settings& settings, Diagnostics& diagnostics);

/// Renames the rig: the global group of the skeleton and of every joint.
void set_global(TaggedSkeleton& skeleton, const std::string& global);

}  // namespace rigc::tags
