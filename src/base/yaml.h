// SPDX-License-Identifier: MIT
// YAML as a tree with source spans. The one place that knows yaml-cpp. Duplicate keys, several
// documents, cyclic or exploding aliases, deep nesting, files above 4 MB and bad UTF-8 are errors;
// `<<` is merged; scalars stay text until somebody asks for a type.
// Test: tests/base/yaml_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"

namespace rigc::yaml {

enum class NodeKind : std::uint8_t { null, scalar, sequence, map };

/// One node. A map keeps the order of its keys; keys are scalars.
struct Node {
  NodeKind kind = NodeKind::null;
  Span span;
  std::string text;         ///< of a scalar
  bool quoted = false;      ///< a quoted or block scalar is never a number, boolean or null
  std::vector<Node> items;  ///< of a sequence
  struct Entry;
  std::vector<Entry> entries;  ///< of a map

  bool is_null() const { return kind == NodeKind::null; }
  bool is_scalar() const { return kind == NodeKind::scalar; }
  bool is_sequence() const { return kind == NodeKind::sequence; }
  bool is_map() const { return kind == NodeKind::map; }
  const Node* find(std::string_view key) const;
  const Entry* find_entry(std::string_view key) const;
};

struct Node::Entry {
  std::string key;
  Span key_span;
  Node value;
};

/// Reads one document. `file` is a number from Diagnostics::sources(). An empty document is a null
/// node.
std::optional<Node> read(std::uint32_t file, Diagnostics& diagnostics);

/// The typed readers: each reports at the node's span and returns nothing on a mismatch. `what`
/// names the value in the message ("size"). Numbers by parse_number; booleans are true, false, on,
/// off.
std::optional<double> as_number(const Node& node, std::string_view what, Diagnostics& diagnostics);
std::optional<long long> as_integer(const Node& node, std::string_view what,
                                    Diagnostics& diagnostics);
std::optional<bool> as_bool(const Node& node, std::string_view what, Diagnostics& diagnostics);
std::optional<std::string> as_text(const Node& node, std::string_view what,
                                   Diagnostics& diagnostics);
std::optional<std::string> as_name(const Node& node, std::string_view what,
                                   Diagnostics& diagnostics);
/// A sequence of exactly `count` numbers.
std::optional<std::vector<double>> as_numbers(const Node& node, std::size_t count,
                                              std::string_view what, Diagnostics& diagnostics);
/// Reports every key of a map that is not in `known`, with "did you mean"; also that it is a map at
/// all.
bool check_keys(const Node& node, const std::vector<std::string>& known, std::string_view what,
                Diagnostics& diagnostics);

}  // namespace rigc::yaml
