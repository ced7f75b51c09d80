// SPDX-License-Identifier: MIT
// Reads where a joint stands: at, translate, rotate, quat, orient, scale, chain.
// Test: tests/templates/read_test.cpp
#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "templates/arguments.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/reader.h"

namespace rigc::templates {
namespace {

std::optional<math::Vec3> read_axis(Reader& reader, const yaml::Node& node, std::string_view what) {
  const auto text = yaml::as_text(node, what, reader.diagnostics);
  if (!text) return std::nullopt;
  std::string_view axis = *text;
  double sign = 1;
  if (starts_with(axis, "+") || starts_with(axis, "-")) {
    sign = axis[0] == '-' ? -1 : 1;
    axis.remove_prefix(1);
  }
  if (axis == "x") return math::Vec3{sign, 0, 0};
  if (axis == "y") return math::Vec3{0, sign, 0};
  if (axis == "z") return math::Vec3{0, 0, sign};
  reader.error(codes::kUnknownWord, node.span,
               fmt::format("{}: \"{}\" is no axis", what, printable(*text, 40)),
               suggest(*text, orient_format().words("aim")));
  return std::nullopt;
}

void read_orient(Reader& reader, const yaml::Node& node, Placement& placement) {
  if (!yaml::check_section(node, orient_format(), reader.diagnostics)) return;
  Orient orient;
  orient.span = node.span;
  if (const yaml::Node* aim = node.find("aim"))
    if (const auto axis = read_axis(reader, *aim, "aim")) orient.aim = *axis;
  if (const yaml::Node* up = node.find("up"))
    if (const auto axis = read_axis(reader, *up, "up")) orient.up = *axis;
  if (dot(orient.aim, orient.up) != 0)
    reader.error(codes::kBadAxes, node.span, "`aim` and `up` are the same axis",
                 "turn another axis up");
  orient.up_toward = orient.up;
  if (const yaml::Node* toward = node.find("up_toward")) {
    const auto direction = reader.vector(*toward, "up_toward");
    if (direction && length(*direction) < 1e-9)
      reader.error(codes::kBadAxes, toward->span, "`up_toward` has no length");
    else if (direction)
      orient.up_toward = normalised(*direction);
  }
  if (const yaml::Node* toward = node.find("toward"))
    orient.toward = yaml::as_name(*toward, "toward", reader.diagnostics).value_or("");
  placement.orient = orient;
}

std::optional<math::Quat> read_quaternion(Reader& reader, const yaml::Node& node) {
  const auto numbers = yaml::as_numbers(node, 4, "quat", reader.diagnostics);
  if (!numbers) return std::nullopt;
  const math::Quat q{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
  if (!(dot(q, q) > 1e-12) || !(dot(q, q) < 1e12)) {
    reader.error(codes::kZeroQuaternion, node.span, "the quaternion cannot be brought to length 1",
                 "[0, 0, 0, 1] is no rotation");
    return std::nullopt;
  }
  // One that is as long as rounding allows stays as written: what rigc writes reads back the same.
  return std::abs(dot(q, q) - 1) < 1e-14 ? q : normalised(q);
}

void read_orientation(Reader& reader, const yaml::Node& node, Placement& placement) {
  const yaml::Node::Entry* first = nullptr;
  for (const char* key : {"rotate", "quat", "orient"}) {
    const yaml::Node::Entry* entry = node.find_entry(key);
    if (!entry) continue;
    if (first) {
      reader.error(codes::kPlacementTwice, entry->key_span,
                   fmt::format("the joint has both `{}` and `{}`", first->key, entry->key),
                   "keep one of them");
      continue;
    }
    first = entry;
    const std::string_view word = key;
    if (word == "rotate")
      placement.rotation = reader.euler(entry->value, key).value_or(math::Quat{});
    else if (word == "quat")
      placement.rotation = read_quaternion(reader, entry->value).value_or(math::Quat{});
    else
      read_orient(reader, entry->value, placement);
  }
}

void read_position(Reader& reader, const yaml::Node& node, Joint& joint) {
  const yaml::Node::Entry* at = node.find_entry("at");
  const yaml::Node::Entry* translate = node.find_entry("translate");
  if (at && translate)
    reader.error(codes::kPlacementTwice, translate->key_span,
                 "the joint has both `at` and `translate`", "keep one of them");
  if (at) {
    joint.placement.space = Placement::Space::model;
    joint.placement.position = reader.metres(at->value, "at").value_or(math::Vec3{});
  } else if (translate) {
    joint.placement.position = reader.metres(translate->value, "translate").value_or(math::Vec3{});
  }
}

void read_scale(Reader& reader, const yaml::Node& node, Placement& placement) {
  const auto scale = reader.vector(node, "scale");
  if (!scale) return;
  if (scale->x > kSmallestScale && scale->y > kSmallestScale && scale->z > kSmallestScale)
    placement.scale = *scale;
  else
    reader.error(codes::kNotAllowed, node.span, "scale: every number must be above 0",
                 "mirrored parts are written `mirror: x`");
}

std::optional<Count> read_count(Reader& reader, const yaml::Node& node) {
  Count count;
  count.span = node.span;
  if (node.is_scalar() && node.text.size() > 1 && node.text[0] == '$') {
    count.parameter = node.text.substr(1);
    if (!reader.check_declared(count.parameter, node.span)) return std::nullopt;
    if (reader.out.find_parameter(count.parameter)->type == catalog::ParameterType::integer)
      return count;
    reader.error(codes::kArgumentValue, node.span,
                 fmt::format("count: ${} is no int", count.parameter));
    return std::nullopt;
  }
  const auto number = yaml::as_integer(node, "count", reader.diagnostics);
  if (!number) return std::nullopt;
  if (*number < 1 || *number > kMostInChain) {
    reader.error(codes::kNotAllowed, node.span,
                 fmt::format("count: {} is not between 1 and {}", *number, kMostInChain));
    return std::nullopt;
  }
  count.value = static_cast<int>(*number);
  return count;
}

math::Trs read_step(Reader& reader, const yaml::Node& node) {
  Placement step;
  if (!yaml::check_section(node, step_format(), reader.diagnostics)) return {};
  if (const yaml::Node* translate = node.find("translate"))
    step.position = reader.metres(*translate, "translate").value_or(math::Vec3{});
  read_orientation(reader, node, step);
  if (const yaml::Node* scale = node.find("scale")) read_scale(reader, *scale, step);
  return {step.position, step.rotation, step.scale};
}

void read_steps(Reader& reader, const yaml::Node& node, Chain& chain) {
  if (!node.is_sequence()) {
    reader.error(codes::kMissingKey, node.span, "`steps` is a list", "write `- translate: ...`");
    return;
  }
  const bool fits = chain.count.parameter.empty() &&
                    node.items.size() + 1 == static_cast<std::size_t>(chain.count.value);
  if (!fits) {
    reader.error(codes::kNotAllowed, node.span,
                 fmt::format("steps: {} do not make a chain of `count`", node.items.size()),
                 "there is one step for every joint but the first");
    return;
  }
  for (const yaml::Node& item : node.items) chain.steps.push_back(read_step(reader, item));
}

void read_chain(Reader& reader, const yaml::Node& node, Joint& joint) {
  if (!yaml::check_section(node, chain_format(), reader.diagnostics)) return;
  Chain chain;
  chain.span = node.span;
  if (const yaml::Node* count = reader.required(node, "count", "a chain"))
    if (const auto number = read_count(reader, *count)) chain.count = *number;
  const yaml::Node::Entry* steps = node.find_entry("steps");
  if (steps && node.find("to"))
    reader.error(codes::kPlacementTwice, steps->key_span, "the chain has both `to` and `steps`",
                 "keep one of them");
  else if (steps)
    read_steps(reader, steps->value, chain);
  else if (const yaml::Node* to = reader.required(node, "to", "a chain"))
    if (const auto position = reader.metres(*to, "to")) chain.to = *position;
  joint.chain = chain;
}

}  // namespace

void read_placement(Reader& reader, const yaml::Node& node, Joint& joint) {
  read_position(reader, node, joint);
  read_orientation(reader, node, joint.placement);
  if (const yaml::Node* scale = node.find("scale")) read_scale(reader, *scale, joint.placement);
  if (const yaml::Node* chain = node.find("chain")) read_chain(reader, *chain, joint);
}

}  // namespace rigc::templates
