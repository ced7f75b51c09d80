// SPDX-License-Identifier: MIT
// Writes JSON text, the same bytes for the same calls on every machine.
// Test: tests/base/json_writer_test.cpp
#include <cassert>
#include <cmath>

#include "base/json.h"
#include "base/text.h"

namespace rigc::json {
namespace {

constexpr std::size_t kMostInline = 90;

}  // namespace

void Writer::separate() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (frames_.empty()) return;
  Frame& frame = frames_.back();
  if (frame.has_items) out_ += ',';
  frame.has_items = true;
  if (indent_ > 0) {
    out_ += '\n';
    out_.append(frames_.size() * static_cast<std::size_t>(indent_), ' ');
  }
}

void Writer::open(char bracket) {
  separate();
  if (!frames_.empty()) frames_.back().only_numbers = false;
  frames_.push_back({out_.size(), false, bracket == '['});
  out_ += bracket;
}

void Writer::close(char bracket) {
  assert(!frames_.empty() && !after_key_);
  const Frame frame = frames_.back();
  frames_.pop_back();
  if (indent_ > 0 && frame.has_items && !(frame.only_numbers && shorten(frame.begin))) {
    out_ += '\n';
    out_.append(frames_.size() * static_cast<std::size_t>(indent_), ' ');
  }
  out_ += bracket;
}

bool Writer::shorten(std::size_t begin) {
  // An element takes at least two characters and its indentation: long arrays are not tried.
  const std::size_t indentation = (frames_.size() + 1) * static_cast<std::size_t>(indent_) + 1;
  if (out_.size() - begin > kMostInline * (indentation + 2)) return false;
  std::string line = "[";
  for (std::size_t i = begin + 1; i < out_.size(); ++i) {
    if (out_[i] == '\n') {
      if (line.size() > 1) line += ' ';
      i += indentation - 1;
    } else {
      line += out_[i];
    }
  }
  if (line.size() > kMostInline) return false;
  out_.replace(begin, std::string::npos, line);
  return true;
}

Writer& Writer::begin_object() { return open('{'), *this; }
Writer& Writer::end_object() { return close('}'), *this; }
Writer& Writer::begin_array() { return open('['), *this; }
Writer& Writer::end_array() { return close(']'), *this; }

Writer& Writer::key(std::string_view name) {
  assert(!frames_.empty() && !after_key_);
  separate();
  out_ += quote(name);
  out_ += indent_ > 0 ? ": " : ":";
  after_key_ = true;
  return *this;
}

Writer& Writer::raw(std::string_view text) {
  separate();
  if (!frames_.empty()) frames_.back().only_numbers = false;
  out_ += text;
  return *this;
}

Writer& Writer::value(std::string_view text) { return raw(quote(text)); }
Writer& Writer::value(bool flag) { return raw(flag ? "true" : "false"); }
Writer& Writer::null() { return raw("null"); }

Writer& Writer::value(double number) {
  assert(std::isfinite(number));
  separate();
  out_ += std::isfinite(number) ? number_text(number) : "null";
  return *this;
}

Writer& Writer::integer(std::int64_t number) {
  separate();
  out_ += std::to_string(number);
  return *this;
}

Writer& Writer::numbers(const double* first, std::size_t count) {
  separate();
  if (!frames_.empty()) frames_.back().only_numbers = false;
  out_ += '[';
  for (std::size_t i = 0; i < count; ++i) {
    assert(std::isfinite(first[i]));
    if (i != 0) out_ += indent_ > 0 ? ", " : ",";
    out_ += std::isfinite(first[i]) ? number_text(first[i]) : "null";
  }
  out_ += ']';
  return *this;
}

std::string quote(std::string_view text) {
  std::string replaced;
  if (!is_utf8(text)) {
    // File names may be any bytes; JSON must be UTF-8.
    replaced = printable(text, text.size() * 4);
    text = replaced;
  }
  std::string out = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\r') {
      out += "\\r";
    } else if (c == '\t') {
      out += "\\t";
    } else if (byte < 0x20) {
      out += "\\u00";
      out += "0123456789abcdef"[byte >> 4];
      out += "0123456789abcdef"[byte & 15];
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace rigc::json
