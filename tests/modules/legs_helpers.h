// SPDX-License-Identifier: MIT
// A body with legs and feet that tests of legs rig.
#pragma once

#include <string>

#include "modules/bodies_helpers.h"

namespace rigc::test {

/// Root, hips with a body control and an FK hips control, and on both sides thigh, shin, foot, ball
/// and tip: groups torso, leg_l, leg_r, labels root, hips, upper, lower, end, ball, tip. The legs
/// are ik_fk_limbs in IK, the toes have controls, the right side mirrors the left. `more` is YAML
/// of commands of the thighs, a list item a line, `{s}` the side; `body_more` of the hips.
std::string legs(const std::string& more, double ik_fk = 1, const std::string& body_more = {});

}  // namespace rigc::test
