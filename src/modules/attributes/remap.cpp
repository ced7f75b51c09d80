// SPDX-License-Identifier: MIT
// remap: maps an attribute through a curve from one range to another.
// Test: tests/modules/attributes_test.cpp
#include "modules/attributes/plugs.h"
#include "modules/registry.h"

namespace rigc::modules {

void remap(Builder& b) {
  namespace attribute = scene::remap;
  const Parameters& with = b.with();
  const Plug from = with.plug("from");
  const Plug to = with.plug("to");
  if (!check_number(b, from, "from") || !check_input(b, to, "to") || !check_number(b, to, "to"))
    return;
  const NodeId node = b.make({.kind = scene::Kind::remap,
                              .role = "utility",
                              .joint = {},
                              .parent = {},
                              .suffix = "remap"});
  b.set({node, attribute::kInputMin}, with.number("input_min"));
  b.set({node, attribute::kInputMax}, with.number("input_max"));
  b.set({node, attribute::kOutputMin}, with.number("output_min"));
  b.set({node, attribute::kOutputMax}, with.number("output_max"));
  b.set({node, attribute::kPoints}, with.numbers("curve"));
  b.set({node, attribute::kClamp}, with.flag("clamp") ? 1.0 : 0.0);
  b.connect(from, {node, attribute::kInput});
  b.connect({node, attribute::kOutput}, to);
}

}  // namespace rigc::modules
