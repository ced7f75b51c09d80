// SPDX-License-Identifier: MIT
// Selectors: nameless references to nodes and plugs. Parse, print, rename; resolving is
// traversal's. The grammar stands in docs/selectors.md. Test: tests/selector/parse_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"

namespace rigc::selector {

/// One end of an index item.
struct Index {
  enum class Kind : std::uint8_t { number, start, middle, end };
  Kind kind = Kind::number;
  int number = 0;  ///< negative counts from the end
  bool operator==(const Index&) const = default;
};

/// `3`, `1..3`, `START`, `*`.
struct IndexItem {
  bool all = false;
  Index first;
  std::optional<Index> last;  ///< of a range, inclusive
  bool operator==(const IndexItem&) const = default;
};

/// `/module#id.role[indices]`. module "*" is any.
struct Made {
  std::string module;
  std::string id;
  std::string role;
  std::vector<IndexItem> indices;
  bool operator==(const Made&) const = default;
};

enum class Scope : std::uint8_t { self /* . */, parent /* .. */, group /* local[.label] */ };

struct Choice {
  std::string global;
  Scope scope = Scope::group;
  std::string local;
  std::string label;
  std::vector<IndexItem> indices;
  std::optional<Made> made;
  std::string kind;
  std::string attribute;
  std::string component;  ///< x y z w, or empty
  Span span;
  bool operator==(const Choice& other) const;  ///< spans aside
};

struct Selector {
  std::vector<Choice> choices;  ///< at least one
  bool optional = false;
  Span span;
  bool operator==(const Selector& other) const {
    return choices == other.choices && optional == other.optional;
  }
};

/// `span` is where `text` begins in its source (diagnostics point into it). The whole text or an
/// error.
std::optional<Selector> parse(std::string_view text, const Span& span, Diagnostics& diagnostics);

/// The canonical text; parse(print(s)) == s.
std::string print(const Selector& selector);

/// Renames local groups (parts): pairs of (old, new); a group that is in no pair stays.
void rename_groups(Selector& selector,
                   const std::vector<std::pair<std::string, std::string>>& groups);

/// An expression cut at its braces: text pieces and the selectors between them, piece, selector,
/// piece, ...
struct Expression {
  std::vector<std::string> pieces;  ///< one more than selectors
  std::vector<Selector> selectors;
};
std::optional<Expression> parse_expression(std::string_view text, const Span& span,
                                           Diagnostics& diagnostics);
std::string print(const Expression& expression);

}  // namespace rigc::selector
