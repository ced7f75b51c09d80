// SPDX-License-Identifier: MIT
// What the attribute modules share.
// Test: tests/modules/attributes_test.cpp
#include "modules/attributes/plugs.h"

#include <fmt/format.h>

#include "modules/codes.h"

namespace rigc::modules {

bool check_input(Builder& b, const Plug& plug, std::string_view parameter) {
  const scene::Role role = b.scene().role(plug);
  if (role == scene::Role::input) return true;
  b.fail(codes::kNotSettable, parameter,
         fmt::format("{} of {} is {}", b.scene().plug_name(plug),
                     traversal::describe(b.scene(), plug.node),
                     role == scene::Role::output ? "computed" : "fixed when its node is made"));
  return false;
}

bool check_number(Builder& b, const Plug& plug, std::string_view parameter) {
  if (b.scene().type(plug) == scene::Type::number) return true;
  b.fail(codes::kTypesDiffer, parameter,
         fmt::format("{} of {} is no number", b.scene().plug_name(plug),
                     traversal::describe(b.scene(), plug.node)),
         "name a component, for example @translate.x");
  return false;
}

}  // namespace rigc::modules
