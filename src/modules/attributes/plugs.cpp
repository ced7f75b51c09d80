// SPDX-License-Identifier: MIT
// What the attribute modules share.
// Test: tests/modules/attributes_test.cpp
#include "modules/attributes/plugs.h"

#include <fmt/format.h>

#include "base/text.h"
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

std::string why_unfit(const scene::UserAttribute& attribute, double value) {
  using Flavour = scene::UserAttribute::Flavour;
  const std::string number = number_text(value);
  const bool whole = value >= -9e15 && value <= 9e15 &&
                     value == static_cast<double>(static_cast<long long>(value));
  if (attribute.flavour == Flavour::integer && !whole) {
    return fmt::format("{} is {}, no whole number", attribute.name, number);
  }
  if (attribute.flavour == Flavour::boolean && value != 0 && value != 1) {
    return fmt::format("{} is {}, neither on nor off", attribute.name, number);
  }
  if (attribute.min && value < *attribute.min) {
    return fmt::format("{} is {}, below its smallest value {}", attribute.name, number,
                       number_text(*attribute.min));
  }
  if (attribute.max && value > *attribute.max) {
    return fmt::format("{} is {}, above its largest value {}", attribute.name, number,
                       number_text(*attribute.max));
  }
  return {};
}

}  // namespace rigc::modules
