// SPDX-License-Identifier: MIT
// expression: computes an attribute from others by a formula.
// Test: tests/modules/attributes_test.cpp
#include "modules/attributes/plugs.h"
#include "modules/registry.h"
#include "scene/formula.h"

namespace rigc::modules {

void expression(Builder& b) {
  namespace attribute = scene::expression;
  const Plug to = b.with().plug("to");
  if (!check_input(b, to, "to") || !check_number(b, to, "to")) return;
  const BoundExpression& bound = b.with().expression("value");
  if (!b.check_formula("value", bound)) return;
  const NodeId node = b.make({.kind = scene::Kind::expression,
                              .role = "utility",
                              .joint = {},
                              .parent = {},
                              .suffix = "expression"});
  b.set({node, attribute::kCode}, bound.code);
  for (std::size_t i = 0; i < bound.plugs.size(); ++i) {
    const Plug input{node, attribute::kInputs, static_cast<std::int32_t>(i)};
    b.set(input, 0.0);
    b.connect(bound.plugs[i], input);
  }
  b.connect({node, attribute::kOutput}, to);
}

}  // namespace rigc::modules
