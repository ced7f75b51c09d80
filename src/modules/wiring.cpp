// SPDX-License-Identifier: MIT
// Attributes, formulas and places. Test: tests/modules/ik_fk_limb_test.cpp
#include "modules/wiring.h"

namespace rigc::modules {

Plug add_number(Builder& b, NodeId control, const NumberAttribute& attribute) {
  scene::UserAttribute user;
  user.name = attribute.name;
  user.flavour = attribute.flavour;
  user.value = user.initial = attribute.value;
  user.min = attribute.min;
  user.max = attribute.max;
  return b.add_attribute(control, std::move(user));
}

Plug formula(Builder& b, NodeId joint, const std::string& suffix, const std::string& code,
             const std::vector<Plug>& inputs, const std::string& role) {
  namespace expression = scene::expression;
  const NodeId node = b.make({.kind = scene::Kind::expression,
                              .role = role,
                              .joint = joint,
                              .parent = {},
                              .suffix = suffix});
  b.set({node, expression::kCode}, code);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Plug input{node, expression::kInputs, static_cast<std::int32_t>(i)};
    if (inputs[i].attribute >= scene::kUserAttributes) b.set(input, b.scene().number(inputs[i]));
    b.connect(inputs[i], input);
  }
  return {node, expression::kOutput};
}

NodeId make_place(Builder& b, NodeId joint, const std::string& suffix, NodeId space,
                  const math::Affine& frame) {
  const NodeId place = b.make({.kind = scene::Kind::transform,
                               .role = "space",
                               .joint = joint,
                               .parent = {},
                               .suffix = suffix});
  hang(b, place, space, frame);
  return place;
}

void follow_world(Builder& b, const Plug& input, NodeId node) {
  b.set(input, rest(b, node));
  b.connect(world_of(node), input);
}

}  // namespace rigc::modules
