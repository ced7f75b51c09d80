// SPDX-License-Identifier: MIT
// set: gives an attribute another value.
// Test: tests/modules/attributes_test.cpp
#include "modules/attributes/plugs.h"
#include "modules/registry.h"

namespace rigc::modules {

void set(Builder& b) {
  const Plug plug = b.with().plug("plug");
  if (check_input(b, plug, "plug") && b.check_free(plug, "plug")) give_value(b, plug, "value");
}

}  // namespace rigc::modules
