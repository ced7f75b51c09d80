// SPDX-License-Identifier: MIT
// Layers above controls. Test: tests/modules/pivot_test.cpp
#include "modules/layers.h"

#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/made.h"

namespace rigc::modules {

NodeId zero_of(const Builder& b, NodeId control) {
  NodeId at = b.scene()[control].parent;
  while (at.valid() && b.scene()[at].identity.role != "zero") at = b.scene()[at].parent;
  return at;
}

NodeId make_layer(Builder& b, NodeId control, const std::string& suffix) {
  const NodeId layer = b.make({.kind = scene::Kind::transform,
                               .role = "driver",
                               .joint = owner(b, control),
                               .parent = b.scene()[control].parent,
                               .suffix = suffix});
  b.reparent(control, layer);
  return layer;
}

Plug add_to(Builder& b, NodeId control, const NumberAttribute& attribute,
            std::string_view parameter) {
  if (!b.scene().find_plug(control, attribute.name)) return add_number(b, control, attribute);
  b.fail(codes::kAttributeExists, parameter,
         fmt::format("{} has an attribute \"{}\" already", traversal::describe(b.scene(), control),
                     attribute.name));
  return {};
}

}  // namespace rigc::modules
