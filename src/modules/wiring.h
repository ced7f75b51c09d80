// SPDX-License-Identifier: MIT
// The small nodes and attributes that modules put between controls and joints: what an animator can
// key, values computed from others, places that move with something.
// Test: tests/modules/ik_fk_limb_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/steps.h"

namespace rigc::modules {

/// A number that an animator keys on a control.
struct NumberAttribute {
  std::string name;
  double value = 0;  ///< at rest
  std::optional<double> min = {}, max = {};
  scene::UserAttribute::Flavour flavour = scene::UserAttribute::Flavour::number;
};
Plug add_number(Builder& b, NodeId control, const NumberAttribute& attribute);

/// What a formula gives, in a node of `joint`; $0, $1... stand for the inputs. `suffix` ends the
/// node's name.
Plug formula(Builder& b, NodeId joint, const std::string& suffix, const std::string& code,
             const std::vector<Plug>& inputs, const std::string& role = "driver");

/// A transform of `joint` at `frame` (rig space) that moves with `space`.
NodeId make_place(Builder& b, NodeId joint, const std::string& suffix, NodeId space,
                  const math::Affine& frame);

/// Lets a matrix input follow the world of a node, and hold where that rests.
void follow_world(Builder& b, const Plug& input, NodeId node);

}  // namespace rigc::modules
