// SPDX-License-Identifier: MIT
// Where text came from: a span points into a source text, Sources owns those texts.
// Test: tests/base/diagnostics_test.cpp
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rigc {

/// A place in a source text. Lines and columns count from 1 (columns in bytes); file 0 is nowhere.
struct Span {
  std::uint32_t file = 0;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t length = 0;

  bool known() const { return file != 0; }
  bool operator==(const Span&) const = default;
};

/// What made something: the template line, the joint that holds the command, the command's id.
struct Origin {
  Span span;
  std::string joint;
  std::string command;
};

/// The texts that spans point into, by the names that users gave them. A copy shares the texts, and
/// spans into the original mean the same in it.
class Sources {
 public:
  /// Registers a text and returns its number, which spans carry.
  std::uint32_t add(std::string name, std::string text);
  std::string_view name(std::uint32_t file) const;
  std::string_view text(std::uint32_t file) const;
  /// One line of a text without its end of line; empty where there is none.
  std::string_view line(std::uint32_t file, std::uint32_t line) const;

 private:
  struct Source {
    std::string name;
    std::string text;
  };
  std::vector<std::shared_ptr<const Source>> sources_;  // views stay valid while it grows
};

}  // namespace rigc
