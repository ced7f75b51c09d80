// SPDX-License-Identifier: MIT
// Plain values from YAML and from and to JSON.
// Test: tests/base/literal_test.cpp
#include "base/literal.h"

#include <fmt/format.h>

#include "base/codes.h"
#include "base/text.h"

namespace rigc {
namespace {

Literal scalar_from(const yaml::Node& node) {
  if (node.quoted) return Literal::of(node.text);
  if (node.text == "true" || node.text == "on") return Literal::of(true);
  if (node.text == "false" || node.text == "off") return Literal::of(false);
  const auto number = parse_number(node.text);
  if (!number) return Literal::of(node.text);
  Literal literal = Literal::of(*number);
  literal.text = node.text;
  return literal;
}

}  // namespace

bool Literal::operator==(const Literal& other) const {
  if (kind != other.kind) return false;
  switch (kind) {
    case Kind::null:
      return true;
    case Kind::number:
      return number == other.number;
    case Kind::boolean:
      return flag == other.flag;
    case Kind::text:
      return text == other.text;
    case Kind::list:
      return items == other.items;
    case Kind::map:
      return entries == other.entries;
  }
  return false;
}

const Literal* Literal::find(std::string_view key) const {
  for (const auto& [name, value] : entries)
    if (name == key) return &value;
  return nullptr;
}

Literal Literal::of(double number) {
  Literal literal;
  literal.kind = Kind::number;
  literal.number = number;
  literal.text = number_text(number);
  return literal;
}

Literal Literal::of(bool flag) {
  Literal literal;
  literal.kind = Kind::boolean;
  literal.flag = flag;
  return literal;
}

Literal Literal::of(std::string text) {
  Literal literal;
  literal.kind = Kind::text;
  literal.text = std::move(text);
  return literal;
}

std::optional<Literal> literal_from(const yaml::Node& node, Diagnostics& diagnostics) {
  if (node.is_scalar() && !node.quoted && (node.text == "yes" || node.text == "no")) {
    diagnostics.report(codes::kNotABoolean, node.span,
                       fmt::format("\"{}\" is no boolean here", node.text),
                       "write true or false (or on/off), or put it in quotes if it is text");
    return std::nullopt;
  }
  Literal literal;
  if (node.is_scalar()) literal = scalar_from(node);
  literal.span = node.span;
  bool complete = true;
  if (node.is_sequence()) {
    literal.kind = Literal::Kind::list;
    for (const yaml::Node& item : node.items) {
      auto value = literal_from(item, diagnostics);
      if (!value) complete = false;
      if (value) literal.items.push_back(std::move(*value));
    }
  } else if (node.is_map()) {
    literal.kind = Literal::Kind::map;
    for (const yaml::Node::Entry& entry : node.entries) {
      auto value = literal_from(entry.value, diagnostics);
      if (!value) complete = false;
      if (value) literal.entries.push_back({entry.key, std::move(*value)});
    }
  }
  if (!complete) return std::nullopt;
  return literal;
}

void write(json::Writer& writer, const Literal& literal) {
  switch (literal.kind) {
    case Literal::Kind::null:
      writer.null();
      return;
    case Literal::Kind::number:
      writer.value(literal.number);
      return;
    case Literal::Kind::boolean:
      writer.value(literal.flag);
      return;
    case Literal::Kind::text:
      writer.value(literal.text);
      return;
    case Literal::Kind::list:
      writer.begin_array();
      for (const Literal& item : literal.items) write(writer, item);
      writer.end_array();
      return;
    case Literal::Kind::map:
      writer.begin_object();
      for (const auto& [key, value] : literal.entries) {
        writer.key(key);
        write(writer, value);
      }
      writer.end_object();
      return;
  }
}

std::optional<Literal> literal_from(const json::Value& value) {
  if (!value) return std::nullopt;
  Literal literal;
  switch (value.kind()) {
    case json::ValueKind::null:
      return literal;
    case json::ValueKind::boolean:
      return Literal::of(value.boolean().value_or(false));
    case json::ValueKind::number:
      literal = Literal::of(value.number().value_or(0));
      literal.text = value.text();
      return literal;
    case json::ValueKind::string:
      return Literal::of(value.string().value_or(""));
    case json::ValueKind::array:
      literal.kind = Literal::Kind::list;
      for (const json::Value& item : value.items()) {
        auto inner = literal_from(item);
        if (inner) literal.items.push_back(std::move(*inner));
      }
      return literal;
    case json::ValueKind::object:
      literal.kind = Literal::Kind::map;
      for (const auto& [key, member] : value.members()) {
        auto inner = literal_from(member);
        if (inner) literal.entries.push_back({key, std::move(*inner)});
      }
      return literal;
  }
  return std::nullopt;
}

}  // namespace rigc
