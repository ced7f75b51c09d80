// SPDX-License-Identifier: MIT
// Gives a plug the value of a parameter.
// Test: tests/modules/attributes_test.cpp
#include <fmt/format.h>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"

namespace rigc::modules {
namespace {

/// The literal as a value of the plug's type, nothing if it does not fit.
std::optional<scene::Value> value_for(scene::Type type, const Literal& literal) {
  switch (type) {
    case scene::Type::number:
      if (literal.kind == Literal::Kind::number) return literal.number;
      if (literal.kind == Literal::Kind::boolean) return literal.flag ? 1.0 : 0.0;
      return std::nullopt;
    case scene::Type::vec3:
      if (literal.items.size() != 3) return std::nullopt;
      return math::Vec3{literal.items[0].number, literal.items[1].number, literal.items[2].number};
    case scene::Type::text:
      if (literal.kind != Literal::Kind::text) return std::nullopt;
      return literal.text;
    default:
      return std::nullopt;
  }
}

/// Whether a number lies in the range of the user attribute that it is for; fails where it does
/// not.
bool check_range(Builder& b, const Plug& plug, const scene::Value& value,
                 std::string_view parameter) {
  if (plug.attribute < scene::kUserAttributes) return true;
  const auto& attribute = b.scene()[plug.node].user[plug.attribute - scene::kUserAttributes];
  const std::string why = why_unfit(attribute, std::get<double>(value));
  if (why.empty()) return true;
  b.fail(codes::kValueDoesNotFit, parameter, why);
  return false;
}

/// `rotate` is the Euler view of `rotation`: what is stored is the rotation.
void set_rotate(Builder& b, const Plug& plug, const scene::Value& value) {
  const Plug rotation{plug.node, scene::transform::kRotation};
  math::Vec3 angles;
  if (plug.component < 0) {
    angles = std::get<math::Vec3>(value);
  } else {
    angles = math::to_euler_degrees(std::get<math::Quat>(b.scene().value(rotation)));
    angles[static_cast<std::size_t>(plug.component)] = std::get<double>(value);
  }
  b.set(rotation, math::from_euler_degrees(angles));
}

}  // namespace

bool give_value(Builder& b, const Plug& plug, std::string_view parameter) {
  const auto type = b.scene().type(plug);
  const auto value = type ? value_for(*type, b.with().literal(parameter)) : std::nullopt;
  if (!value) {
    b.fail(codes::kValueDoesNotFit, parameter,
           fmt::format("{} takes a {}", b.scene().plug_name(plug),
                       type ? scene::name_of(*type) : "value"));
    return false;
  }
  if (!check_range(b, plug, *value, parameter)) return false;
  const bool is_transform = scene::spec(b.scene()[plug.node].kind).is_transform;
  if (is_transform && plug.attribute == scene::transform::kRotate)
    set_rotate(b, plug, *value);
  else
    b.set(plug, *value);
  return true;
}

}  // namespace rigc::modules
