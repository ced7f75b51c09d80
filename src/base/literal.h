// SPDX-License-Identifier: MIT
// A value as written in a template or descriptor: what tags carry as arguments.
// Test: tests/base/literal_test.cpp
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/yaml.h"

namespace rigc {

/// A small tree of plain values with the spans they were read from. Spans take no part in equality.
struct Literal {
  enum class Kind : std::uint8_t { null, number, boolean, text, list, map };
  Kind kind = Kind::null;
  bool flag = false;
  double number = 0;
  std::string text;            ///< of a text; of a number: its spelling
  std::vector<Literal> items;  ///< of a list
  struct Entry;
  std::vector<Entry> entries;  ///< of a map, in written order
  Span span;

  bool operator==(const Literal& other) const;
  const Literal* find(std::string_view key) const;

  static Literal of(double number);
  static Literal of(bool flag);
  static Literal of(std::string text);
  static Literal of(const char* text);
};

/// A key of a map with its value.
struct Literal::Entry {
  std::string first;
  Literal second;
  bool operator==(const Entry& other) const = default;
};

inline Literal Literal::of(const char* text) { return of(std::string(text)); }

/// Plain `true false on off` become booleans, plain numbers numbers, everything else text.
/// Plain `yes` and `no` are reported; the result is then empty.
std::optional<Literal> literal_from(const yaml::Node& node, Diagnostics& diagnostics);
/// As JSON (texts as strings, numbers by number_text) and back; spans are not kept.
void write(json::Writer& writer, const Literal& literal);
std::optional<Literal> literal_from(const json::Value& value);

}  // namespace rigc
