// SPDX-License-Identifier: MIT
// The keys of template files, format 1, and of maps as tables: the readers of this folder and the
// JSON Schemas share them. Test: tests/templates/read_test.cpp, tools/node/check_templates.mjs
#pragma once

#include "base/format.h"

namespace rigc::templates {

inline constexpr long long kMostVersion = 1'000'000'000;
inline constexpr int kMostInChain = 1000;
inline constexpr double kSmallestScale = 1e-6;  ///< sizes and scales lie above

const yaml::Section& template_format();
const yaml::Section& parameter_format();
const yaml::Section& feature_declaration_format();  ///< of the catalogue `features:`
const yaml::Section& joint_format();
const yaml::Section& orient_format();
const yaml::Section& chain_format();
const yaml::Section& step_format();
const yaml::Section& command_format();
const yaml::Section& feature_format();  ///< of a tag
const yaml::Section& part_format();
const yaml::Section& map_format();
const yaml::Section& between_format();  ///< of a joint's `guide:`
const yaml::Section& guides_format();   ///< a guides file
const yaml::Section& guide_format();    ///< of a joint in it
const yaml::Section& control_edit_format();

}  // namespace rigc::templates
