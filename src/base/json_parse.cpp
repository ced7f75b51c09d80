// SPDX-License-Identifier: MIT
// One pass over JSON text, without recursion: checks everything and records where each value is.
// Test: tests/base/json_test.cpp, tests/base/json_oracle_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/codes.h"
#include "base/ids.h"
#include "base/json.h"
#include "base/json_strings.h"
#include "base/text.h"

namespace rigc::json {
namespace {

constexpr std::size_t kMostDepth = 512;
constexpr std::size_t kFewMembers = 8;

/// Values in a text. They take 32 bytes each: never more than 32 MB and three times the text.
std::size_t most_items(std::size_t bytes) { return (std::size_t{1} << 20) + bytes / 32 * 3; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

const char* skip_digits(const char* at, const char* end) {
  while (at < end && is_digit(*at)) ++at;
  return at;
}

int hex_value(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Four hex digits, or -1.
int hex4(const char* at, const char* end) {
  if (end - at < 4) return -1;
  int value = 0;
  for (int i = 0; i < 4; ++i) {
    const int digit = hex_value(at[i]);
    if (digit < 0) return -1;
    value = value * 16 + digit;
  }
  return value;
}

void append_utf8(std::string& out, unsigned value) {
  const auto put = [&](unsigned byte) { out += static_cast<char>(byte); };
  if (value < 0x80) {
    put(value);
  } else if (value < 0x800) {
    put(0xc0 | (value >> 6));
    put(0x80 | (value & 0x3f));
  } else if (value < 0x10000) {
    put(0xe0 | (value >> 12));
    put(0x80 | ((value >> 6) & 0x3f));
    put(0x80 | (value & 0x3f));
  } else {
    put(0xf0 | (value >> 18));
    put(0x80 | ((value >> 12) & 0x3f));
    put(0x80 | ((value >> 6) & 0x3f));
    put(0x80 | (value & 0x3f));
  }
}

/// Whether any of eight bytes ends a plain run of a string: a quote, a backslash, a control
/// character or a byte above 0x7f. (Borrows may flag a plain byte too; the caller looks closer.)
bool has_special(const char* at) {
  constexpr std::uint64_t kOnes = 0x0101010101010101u, kHigh = 0x8080808080808080u;
  std::uint64_t word = 0;
  std::memcpy(&word, at, 8);
  const std::uint64_t quotes = word ^ (kOnes * '"'), slashes = word ^ (kOnes * '\\');
  return ((word | (quotes - kOnes) | (slashes - kOnes) | (word - kOnes * 0x20)) & kHigh) != 0;
}

bool is_special(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte >= 0x80 || c == '"' || c == '\\';
}

/// Bytes of the UTF-8 character above 0x7f at `at`; 0 if it is malformed.
std::size_t utf8_length(const char* at, const char* end) {
  const auto first = static_cast<unsigned char>(*at);
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (static_cast<std::size_t>(end - at) < length) return 0;
  return is_utf8({at, length}) ? length : 0;
}

}  // namespace

std::string unescape(std::string_view text) {
  if (text.find('\\') == std::string_view::npos) return std::string(text);
  std::string out;
  out.reserve(text.size());
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    if (*at != '\\') {
      out += *at++;
      continue;
    }
    const char escape = at[1];
    at += 2;
    if (escape != 'u') {
      constexpr std::string_view kFrom = "\"\\/bfnrt", kTo = "\"\\/\b\f\n\r\t";
      out += kTo[kFrom.find(escape)];
      continue;
    }
    auto value = static_cast<unsigned>(hex4(at, end));
    at += 4;
    if (value >= 0xd800 && value < 0xdc00) {
      value =
          0x10000 + ((value - 0xd800) << 10) + static_cast<unsigned>(hex4(at + 2, end)) - 0xdc00;
      at += 6;
    }
    append_utf8(out, value);
  }
  return out;
}

class Parser {
 public:
  Parser(const Document& document, const std::string& file, std::size_t base,
         Diagnostics& diagnostics)
      : text_(document.text()), file_(file), base_(base), diagnostics_(diagnostics) {}

  bool run();
  std::vector<Document::Item> take() { return std::move(items_); }

 private:
  using Item = Document::Item;

  void reserve_items();
  bool parse_value();
  bool after_value();
  bool parse_key();
  bool parse_string();
  bool parse_escape();
  bool parse_number();
  bool parse_word(std::string_view word, ValueKind kind);
  bool open(ValueKind kind);
  void close();
  void check_keys(const Item& object);
  bool begin_item(ValueKind kind);
  void end_item() {
    items_.back().end = position();
    items_.back().next = static_cast<std::uint32_t>(items_.size());
  }

  void skip_blanks() {
    const char* at = at_;  // a local, because stores through char pointers would reload the member
    while (at < end_ && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')) ++at;
    at_ = at;
  }
  std::uint32_t position() const { return static_cast<std::uint32_t>(at_ - text_.data()); }
  std::string_view key_of(const Item& item) const {
    return text_.substr(item.key_begin + 1, item.key_end - item.key_begin - 2);
  }
  bool fail(const Code& code, std::string message) {
    return fail_at(position(), code, std::move(message));
  }
  bool fail_at(std::size_t byte, const Code& code, std::string message);
  std::string found() const;

  std::string_view text_;
  const std::string& file_;
  std::size_t base_;
  Diagnostics& diagnostics_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  std::vector<Item> items_;
  std::vector<std::uint32_t> stack_;
  std::uint32_t key_begin_ = 0, key_end_ = 0;
  bool key_has_escapes_ = false;
  bool string_has_escapes_ = false;  ///< the string parsed last
  bool wants_value_ = true;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> hashes_;
};

bool Parser::fail_at(std::size_t byte, const Code& code, std::string message) {
  const std::string_view before = text_.substr(0, byte);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_begin = before.rfind('\n') + 1;
  diagnostics_.report(
      code, Place::at_byte(file_, base_ + byte),
      fmt::format("{} (line {}, column {} of the JSON)", message, line, byte - line_begin + 1));
  return false;
}

std::string Parser::found() const {
  if (at_ == end_) return "the end of the text";
  return fmt::format("\"{}\"",
                     printable(std::string_view(
                         at_, static_cast<std::size_t>(std::min<std::ptrdiff_t>(end_ - at_, 12)))));
}

bool Parser::run() {
  if (text_.size() > kMostBytes)
    return fail_at(0, codes::kJsonTooLarge, fmt::format("more than {} bytes", kMostBytes));
  at_ = text_.data();
  end_ = at_ + text_.size();
  const std::size_t errors = diagnostics_.errors();
  if (text_.starts_with("\xef\xbb\xbf"))
    return fail(codes::kJsonSyntax, "JSON must not start with a byte order mark");
  reserve_items();
  do {
    if (wants_value_ ? !parse_value() : !after_value()) return false;
  } while (wants_value_ || !stack_.empty());
  skip_blanks();
  if (at_ != end_) return fail(codes::kJsonTrailing, "expected nothing more, not " + found());
  return diagnostics_.errors() == errors;
}

void Parser::reserve_items() {
  // Growing would copy and touch twice the memory. Commas in strings count too, hence the cap.
  std::size_t values = 1;
  for (char c : text_) values += c == ',' || c == '[' || c == '{';
  items_.reserve(std::min(values, most_items(text_.size())));
}

bool Parser::begin_item(ValueKind kind) {
  if (items_.size() == most_items(text_.size()))
    return fail(codes::kJsonTooLarge, fmt::format("more than {} values", items_.size()));
  Item& item = items_.emplace_back();
  item.kind = kind;
  item.begin = position();
  if (!stack_.empty()) {
    item.parent = stack_.back();
    Item& parent = items_[stack_.back()];
    ++parent.count;
    if (parent.kind == ValueKind::object) {
      item.key_begin = key_begin_;
      item.key_end = key_end_;
      item.key_has_escapes = key_has_escapes_;
    }
  }
  return true;
}

bool Parser::parse_value() {
  skip_blanks();
  wants_value_ = false;
  switch (at_ == end_ ? '\0' : *at_) {
    case '{':
      return open(ValueKind::object);
    case '[':
      return open(ValueKind::array);
    case '"':
      if (!begin_item(ValueKind::string) || !parse_string()) return false;
      end_item();
      return true;
    case 't':
      return parse_word("true", ValueKind::boolean);
    case 'f':
      return parse_word("false", ValueKind::boolean);
    case 'n':
      return parse_word("null", ValueKind::null);
    default:
      if (at_ == end_ || (*at_ != '-' && !is_digit(*at_)))
        return fail(codes::kJsonSyntax, "expected a value, not " + found());
      if (!begin_item(ValueKind::number) || !parse_number()) return false;
      end_item();
      return true;
  }
}

bool Parser::parse_word(std::string_view word, ValueKind kind) {
  if (!std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(word))
    return fail(codes::kJsonSyntax, "expected a value, not " + found());
  if (!begin_item(kind)) return false;
  at_ += word.size();
  end_item();
  return true;
}

bool Parser::open(ValueKind kind) {
  if (stack_.size() == kMostDepth)
    return fail(codes::kJsonTooDeep, fmt::format("nested more than {} deep", kMostDepth));
  if (!begin_item(kind)) return false;
  stack_.push_back(static_cast<std::uint32_t>(items_.size() - 1));
  ++at_;
  skip_blanks();
  if (at_ < end_ && *at_ == (kind == ValueKind::object ? '}' : ']')) {
    close();
    return true;
  }
  wants_value_ = true;
  return kind == ValueKind::array || parse_key();
}

void Parser::close() {
  ++at_;
  Item& item = items_[stack_.back()];
  stack_.pop_back();
  item.end = position();
  item.next = static_cast<std::uint32_t>(items_.size());
  if (item.kind == ValueKind::object && item.count > 1) check_keys(item);
}

bool Parser::after_value() {
  skip_blanks();
  const bool in_object = items_[stack_.back()].kind == ValueKind::object;
  const char c = at_ == end_ ? '\0' : *at_;
  if (c == ',') {
    ++at_;
    wants_value_ = true;
    return !in_object || parse_key();
  }
  if (c == (in_object ? '}' : ']')) {
    close();
    return true;
  }
  return fail(codes::kJsonSyntax,
              fmt::format("expected `,` or `{}`, not {}", in_object ? '}' : ']', found()));
}

bool Parser::parse_key() {
  skip_blanks();
  if (at_ == end_ || *at_ != '"')
    return fail(codes::kJsonSyntax, "expected a key in quotes, not " + found());
  key_begin_ = position();
  if (!parse_string()) return false;
  key_end_ = position();
  key_has_escapes_ = string_has_escapes_;
  skip_blanks();
  if (at_ == end_ || *at_ != ':') return fail(codes::kJsonSyntax, "expected `:`, not " + found());
  ++at_;
  return true;
}

bool Parser::parse_string() {
  const std::uint32_t begin = position();
  ++at_;
  string_has_escapes_ = false;
  while (true) {
    const char* plain = at_;
    while (end_ - plain >= 8 && !has_special(plain)) plain += 8;
    while (plain < end_ && !is_special(*plain)) ++plain;
    at_ = plain;
    if (at_ == end_) return fail_at(begin, codes::kJsonSyntax, "this string has no end");
    if (*at_ == '"') {
      ++at_;
      return true;
    }
    if (*at_ == '\\') {
      string_has_escapes_ = true;
      if (!parse_escape()) return false;
    } else if (static_cast<unsigned char>(*at_) < 0x20) {
      return fail(codes::kJsonBadString, "control character in a string");
    } else {
      const std::size_t length = utf8_length(at_, end_);
      if (length == 0) return fail(codes::kJsonBadUtf8, "bytes that are not UTF-8");
      at_ += length;
    }
  }
}

bool Parser::parse_escape() {
  const char* const begin = at_;
  const auto bad = [&](const char* message) {
    at_ = begin;
    return fail(codes::kJsonBadString, message);
  };
  ++at_;
  const char c = at_ == end_ ? '\0' : *at_++;
  if (c != 'u') {
    if (c != '\0' && std::strchr("\"\\/bfnrt", c)) return true;
    return bad("no escape of JSON");
  }
  const int value = hex4(at_, end_);
  if (value < 0) return bad("\\u needs four hex digits");
  at_ += 4;
  if (value < 0xd800 || value > 0xdfff) return true;
  const bool has_low = value < 0xdc00 && end_ - at_ >= 6 && at_[0] == '\\' && at_[1] == 'u';
  const int low = has_low ? hex4(at_ + 2, end_) : -1;
  if (low < 0xdc00 || low > 0xdfff) return bad("half a surrogate pair");
  at_ += 6;
  return true;
}

bool Parser::parse_number() {
  const char* const begin = at_;
  const char* at = at_ + (*at_ == '-' ? 1 : 0);
  const auto no_digit = [&] {
    at_ = at;
    return fail(codes::kJsonSyntax, "expected a digit, not " + found());
  };
  const char* digits = at;
  at = skip_digits(at, end_);
  const auto whole = at - digits;
  if (whole == 0) return no_digit();
  if (whole > 1 && *digits == '0')
    return fail(codes::kJsonSyntax, "a number must not start with 0");
  bool may_overflow = whole > 300;
  if (at < end_ && *at == '.') {
    digits = ++at;
    at = skip_digits(at, end_);
    if (at == digits) return no_digit();
  }
  if (at < end_ && (*at == 'e' || *at == 'E')) {
    ++at;
    if (at < end_ && (*at == '+' || *at == '-')) ++at;
    digits = at;
    at = skip_digits(at, end_);
    if (at == digits) return no_digit();
    may_overflow = may_overflow || at - digits > 2 || whole > 200;
  }
  if (may_overflow && !rigc::parse_number({begin, static_cast<std::size_t>(at - begin)}))
    return fail(codes::kJsonNumberRange, "this number is too large");
  at_ = at;
  return true;
}

void Parser::check_keys(const Item& object) {
  const auto first = static_cast<std::uint32_t>(&object - items_.data()) + 1;
  const auto report = [&](std::uint32_t index) {
    fail_at(items_[index].key_begin, codes::kJsonDuplicateKey,
            fmt::format("the key \"{}\" occurs twice in this object",
                        printable(unescape(key_of(items_[index])))));
  };
  bool has_escapes = false;
  for (std::uint32_t i = first; i < object.next; i = items_[i].next)
    has_escapes = has_escapes || items_[i].key_has_escapes;
  if (object.count <= kFewMembers && !has_escapes) {
    for (std::uint32_t i = first; i < object.next; i = items_[i].next)
      for (std::uint32_t j = first; j < i; j = items_[j].next)
        if (key_of(items_[i]) == key_of(items_[j])) return report(i);
    return;
  }
  hashes_.clear();
  for (std::uint32_t i = first; i < object.next; i = items_[i].next)
    hashes_.emplace_back(
        has_escapes ? hash64(unescape(key_of(items_[i]))) : hash64(key_of(items_[i])), i);
  // Sorted, not put into a hash table: keys chosen to collide would make that quadratic.
  std::sort(hashes_.begin(), hashes_.end(), [&](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    const std::string one = unescape(key_of(items_[a.second]));
    const int order = one.compare(unescape(key_of(items_[b.second])));
    return order != 0 ? order < 0 : a.second < b.second;
  });
  std::uint32_t duplicate = UINT32_MAX;
  for (std::size_t i = 1; i < hashes_.size(); ++i) {
    const auto &a = hashes_[i - 1], &b = hashes_[i];
    if (a.first == b.first &&
        unescape(key_of(items_[a.second])) == unescape(key_of(items_[b.second])))
      duplicate = std::min(duplicate, b.second);
  }
  if (duplicate != UINT32_MAX) report(duplicate);
}

std::optional<Document> parse(std::string text, const std::string& file, std::size_t base_offset,
                              Diagnostics& diagnostics) {
  Document document;
  document.text_ = std::move(text);
  Parser parser(document, file, base_offset, diagnostics);
  if (!parser.run()) return std::nullopt;
  document.items_ = parser.take();
  return document;
}

}  // namespace rigc::json
