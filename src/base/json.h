// SPDX-License-Identifier: MIT
// JSON as spans of its text: one pass checks everything (grammar, UTF-8, duplicate keys, nesting)
// and records where each value begins and ends, so that a writer can change some spans and copy the
// rest. Test: tests/base/json_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"

namespace rigc::json {

/// Longer texts are refused.
inline constexpr std::size_t kMostBytes = std::size_t{1} << 28;

enum class ValueKind : std::uint8_t { null, boolean, number, string, array, object };

class Document;

/// A value inside a Document: cheap to copy, valid as long as the document. A missing value (`!v`)
/// is returned by lookups that fail, and lookups in it fail too, so chains need no checks.
class Value {
 public:
  Value() = default;
  explicit operator bool() const { return document_ != nullptr; }
  ValueKind kind() const;
  bool is_object() const { return document_ && kind() == ValueKind::object; }
  bool is_array() const { return document_ && kind() == ValueKind::array; }
  bool is_string() const { return document_ && kind() == ValueKind::string; }
  bool is_number() const { return document_ && kind() == ValueKind::number; }

  /// Byte range of the value in the document's text.
  std::size_t begin() const;
  std::size_t end() const;
  std::string_view text() const;

  /// Elements of an array or members of an object, in order. Cost: one step per element passed.
  std::size_t size() const;
  Value operator[](std::string_view key) const;
  /// The element at `index`; O(1) for arrays after the first use is not promised: iterate with
  /// items().
  std::vector<Value> items() const;
  std::vector<std::pair<std::string, Value>> members() const;

  std::optional<double> number() const;  ///< finite
  std::optional<std::int64_t> integer()
      const;  ///< a number written or valued as an integer in +-2^53
  std::optional<bool> boolean() const;
  std::optional<std::string> string() const;  ///< escapes resolved, UTF-8
  /// JSON pointer of this value ("/nodes/3/name"), for diagnostics.
  std::string pointer() const;

 private:
  friend class Document;
  Value(const Document* document, std::uint32_t index) : document_(document), index_(index) {}
  const Document* document_ = nullptr;
  std::uint32_t index_ = 0;
};

/// A parsed text. Moves keep values valid only through root().
class Document {
 public:
  Value root() const;
  std::string_view text() const { return text_; }
  /// How many values there are, at every depth. Each takes 32 bytes.
  std::size_t size() const { return items_.size(); }

 private:
  friend class Value;
  friend class Parser;
  struct Item {
    std::uint32_t begin = 0;  ///< in text
    std::uint32_t end = 0;
    std::uint32_t key_begin = 0;  ///< of an object's member: the key with its quotes
    std::uint32_t key_end = 0;
    std::uint32_t parent = 0;
    std::uint32_t next = 0;   ///< item after this one and all inside it
    std::uint32_t count = 0;  ///< elements or members
    ValueKind kind = ValueKind::null;
    bool key_has_escapes = false;
  };
  std::string text_;
  std::vector<Item> items_;
  friend std::optional<Document> parse(std::string, const std::string&, std::size_t, Diagnostics&);
};

/// Parses a whole text. Nesting above 512, duplicate keys, bad UTF-8, NaN, trailing bytes and all
/// other breaches of RFC 8259 are errors at `file` and a byte offset that starts at `base_offset`.
std::optional<Document> parse(std::string text, const std::string& file, std::size_t base_offset,
                              Diagnostics& diagnostics);

/// Writes JSON text. `indent` 0 is one line; else pretty, with short arrays of numbers on one line.
class Writer {
 public:
  explicit Writer(int indent = 0) : indent_(indent) {}
  Writer& begin_object();
  Writer& end_object();
  Writer& begin_array();
  Writer& end_array();
  Writer& key(std::string_view name);
  Writer& value(std::string_view text);
  Writer& value(const char* text) { return value(std::string_view(text)); }
  Writer& value(const std::string& text) { return value(std::string_view(text)); }
  Writer& value(double number);
  Writer& value(bool flag);
  Writer& value(int number) { return integer(number); }
  Writer& value(unsigned number) { return integer(static_cast<std::int64_t>(number)); }
  Writer& value(std::size_t number) { return integer(static_cast<std::int64_t>(number)); }
  Writer& integer(std::int64_t number);
  Writer& null();
  /// Copies JSON text through.
  Writer& raw(std::string_view text);
  /// `key(name)` and `value(v)`.
  template <class T>
  Writer& member(std::string_view name, const T& v) {
    return key(name).value(v);
  }
  Writer& numbers(const double* first, std::size_t count);
  const std::string& text() const { return out_; }
  std::string take() { return std::move(out_); }

 private:
  void separate();
  void open(char bracket);
  void close(char bracket);
  /// Puts the numbers written since `begin` on one line if they fit.
  bool shorten(std::size_t begin);
  struct Frame {
    std::size_t begin;  ///< of the bracket in out_
    bool has_items;
    bool only_numbers;
  };
  std::string out_;
  std::vector<Frame> frames_;
  int indent_ = 0;
  bool after_key_ = false;
};

/// A string as JSON text with its quotes.
std::string quote(std::string_view text);

}  // namespace rigc::json
