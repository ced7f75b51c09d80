// SPDX-License-Identifier: MIT
// attribute: a number on a node, for animators to key or expressions to read.
// Test: tests/modules/attributes_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {
namespace {

scene::UserAttribute::Flavour flavour_of(const std::string& type) {
  using Flavour = scene::UserAttribute::Flavour;
  if (type == "int") return Flavour::integer;
  if (type == "bool") return Flavour::boolean;
  return type == "angle" ? Flavour::angle : Flavour::number;
}

/// The default as a number; fails where it is no number or lies outside its range.
std::optional<double> initial_value(Builder& b, const scene::UserAttribute& attribute) {
  const Literal& literal = b.with().literal("default");
  if (literal.kind != Literal::Kind::number && literal.kind != Literal::Kind::boolean) {
    b.fail(codes::kValueDoesNotFit, "default",
           "the default of an attribute is a number, on or off");
    return std::nullopt;
  }
  const double value =
      literal.kind == Literal::Kind::boolean ? (literal.flag ? 1.0 : 0.0) : literal.number;
  if (const std::string why = why_unfit(attribute, value); !why.empty()) {
    b.fail(codes::kValueDoesNotFit, "default", why);
    return std::nullopt;
  }
  return value;
}

}  // namespace

void attribute(Builder& b) {
  const Parameters& with = b.with();
  const NodeId node = with.node("on");
  scene::UserAttribute attribute;
  attribute.name = with.text("attribute");
  attribute.flavour = flavour_of(with.text("type"));
  if (with.has("min")) attribute.min = with.number("min");
  if (with.has("max")) attribute.max = with.number("max");
  attribute.keyable = with.flag("keyable");
  if (!is_name(attribute.name) || attribute.name == "rigc") {
    b.fail(codes::kValueDoesNotFit, "attribute",
           fmt::format("\"{}\" cannot name an attribute", printable(attribute.name)),
           "letters, digits, _ and -, not starting with a digit; `rigc` is reserved");
    return;
  }
  if (b.scene().find_plug(node, attribute.name)) {
    b.fail(codes::kAttributeExists, "attribute",
           fmt::format("{} has an attribute \"{}\" already", traversal::describe(b.scene(), node),
                       attribute.name));
    return;
  }
  const auto value = initial_value(b, attribute);
  if (!value) return;
  attribute.value = attribute.initial = *value;
  b.add_attribute(node, std::move(attribute));
}

}  // namespace rigc::modules
