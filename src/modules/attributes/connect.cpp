// SPDX-License-Identifier: MIT
// connect: one attribute gets another's value.
// Test: tests/modules/attributes_test.cpp
#include <fmt/format.h>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/registry.h"

namespace rigc::modules {

void connect(Builder& b) {
  const Plug from = b.with().plug("from");
  const Plug to = b.with().plug("to");
  if (!check_input(b, to, "to")) return;
  const auto from_type = b.scene().type(from);
  const auto to_type = b.scene().type(to);
  if (from_type != to_type || !from_type || scene::width(*from_type) == 0) {
    b.fail(codes::kTypesDiffer, "from",
           fmt::format("{} is a {}, {} takes a {}", b.scene().plug_name(from),
                       from_type ? scene::name_of(*from_type) : "nothing", b.scene().plug_name(to),
                       to_type ? scene::name_of(*to_type) : "nothing"),
           "name a component, for example @translate.x");
    return;
  }
  b.connect(from, to);
}

}  // namespace rigc::modules
