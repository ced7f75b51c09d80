// SPDX-License-Identifier: MIT
// Templates that several tests of modules rig: joints without commands, and the commands put in.
#pragma once

#include <map>
#include <string>

namespace rigc::test {

/// Commands by the name of the joint that holds them, each a YAML flow map such as
/// `{command: control, with: {size: 1}}`, one a line.
using Commands = std::map<std::string, std::string>;

/// A body of 1.8 m facing +Z: root, hips, spine (2), chest, head, and on both sides clavicle, arm
/// (slightly bent back), thigh, shin (bent forward by 4 degrees) and foot. Groups: torso, spine,
/// head, arm_l, arm_r, leg_l, leg_r; labels: root, hips, chest, head, clavicle, upper, lower, end.
std::string body(const Commands& commands);

/// One chain of `count` joints along -Z from [0, 1, 0], group `tail`; below `base` in group `base`.
std::string tail(int count, const Commands& commands);

/// A limb of three joints in group `limb` (upper, lower, end), below `base`: places are YAML flow
/// lists.
std::string limb(const std::string& upper, const std::string& lower, const std::string& end,
                 const Commands& commands);

}  // namespace rigc::test
