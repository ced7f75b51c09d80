// SPDX-License-Identifier: MIT
// The text of a formula as its parser reads it: where it is, words and symbols, what is wrong.
// Test: tests/scene/formula_test.cpp
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>
#include "base/diagnostics.h"
#include "base/text.h"
#include "scene/codes.h"

namespace rigc::scene {

class FormulaText {
 protected:
  FormulaText(std::string_view text, const Span& span, Diagnostics& diagnostics)
      : text_(text), span_(span), diagnostics_(diagnostics) {}

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  }

  // Counts how deep the parser is inside itself, and stops it before the stack does.
  class Level {
   public:
    explicit Level(FormulaText& text) : text_(text) {
      if (++text_.depth_ > kMaxDepth && !text_.stopped_) {
        text_.report(codes::kFormulaTooLarge, "the expression nests too deeply");
        text_.stopped_ = true;
      }
    }
    ~Level() { --text_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    FormulaText& text_;
  };

  void report(const Code& code, const std::string& message, std::string hint = {}) {
    failed_ = true;
    diagnostics_.report(
        code, span_, fmt::format("{}, at column {} of \"{}\"", message, at_ + 1, printable(text_)),
        std::move(hint));
  }

  // After a syntax error nothing more can be said about the rest.
  void syntax(const std::string& message, std::string hint = {}) {
    if (stopped_) return;
    const std::string found = at_ < text_.size()
                                  ? fmt::format("not \"{}\"", printable(text_.substr(at_, 1)))
                                  : "but it ends";
    report(codes::kFormulaSyntax, fmt::format("{}, {}", message, found), std::move(hint));
    stopped_ = true;
  }

  bool is_too_long() {
    if (text_.size() <= kMaxText) return false;
    report(codes::kFormulaTooLarge, "the expression is too long");
    return true;
  }

  void skip_space() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r')) {
      ++at_;
    }
  }

  bool accept(std::string_view symbol) {
    skip_space();
    if (stopped_ || text_.substr(at_, symbol.size()) != symbol) return false;
    at_ += symbol.size();
    return true;
  }

  /// Letters and digits from here on.
  std::string_view word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  std::string_view text_;
  Span span_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
  bool stopped_ = false;  // by an error after which the text cannot be followed

 private:
  static constexpr int kMaxDepth = 100;
  static constexpr std::size_t kMaxText = 100000;
};

}  // namespace rigc::scene
