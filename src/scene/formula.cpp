// SPDX-License-Identifier: MIT
// A recursive descent parser for formulas; one function a level of precedence, loosest first:
// ?:  ||  &&  comparison  + -  * / %  unary - !  ^ (right to left)  primary.
// Test: tests/scene/formula_test.cpp
#include "scene/formula.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include "base/text.h"
#include "scene/codes.h"

namespace rigc::scene {

namespace {

constexpr int kMaxDepth = 100;
constexpr std::size_t kMaxSteps = 10000;
constexpr std::size_t kMaxText = 100000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

struct Operator {
  std::string_view text;
  FormulaOp op;
};

constexpr Operator kComparisons[] = {
    {"<=", FormulaOp::less_equal}, {">=", FormulaOp::greater_equal}, {"==", FormulaOp::equal},
    {"!=", FormulaOp::not_equal},  {"<", FormulaOp::less},           {">", FormulaOp::greater}};
constexpr Operator kSums[] = {{"+", FormulaOp::add}, {"-", FormulaOp::subtract}};
constexpr Operator kProducts[] = {
    {"*", FormulaOp::multiply}, {"/", FormulaOp::divide}, {"%", FormulaOp::modulo}};

class FormulaParser {
 public:
  FormulaParser(std::string_view text, const Span& span, int inputs, Diagnostics& diagnostics)
      : text_(text), span_(span), inputs_(inputs), diagnostics_(diagnostics) {}

  std::optional<Formula> parse() {
    if (text_.size() > kMaxText) {
      report(codes::kFormulaTooLarge, "the expression is too long");
      return std::nullopt;
    }
    choice();
    skip_space();
    if (!stopped_ && at_ < text_.size()) syntax("an operator is expected");
    if (failed_) return std::nullopt;
    return std::move(formula_);
  }

 private:
  // Counts how deep the parser is inside itself, and stops it before the stack does.
  class Level {
   public:
    explicit Level(FormulaParser& parser) : parser_(parser) {
      if (++parser_.depth_ > kMaxDepth && !parser_.stopped_) {
        parser_.report(codes::kFormulaTooLarge, "the expression nests too deeply");
        parser_.stopped_ = true;
      }
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    FormulaParser& parser_;
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

  template <std::size_t n>
  const Operator* accept(const Operator (&operators)[n]) {
    for (const Operator& candidate : operators) {
      if (accept(candidate.text)) return &candidate;
    }
    return nullptr;
  }

  void push(Formula::Step step) {
    if (stopped_) return;
    if (formula_.steps.size() >= kMaxSteps) {
      report(codes::kFormulaTooLarge, "the expression has too many operations");
      stopped_ = true;
      return;
    }
    formula_.steps.push_back(step);
  }
  void push(FormulaOp op) { push({op, 0, 0}); }

  void choice() {
    const Level level(*this);
    either();
    if (!accept("?")) return;
    choice();
    if (!accept(":")) return syntax("\":\" is expected");
    choice();
    push(FormulaOp::select);
  }

  void either() {
    both();
    while (accept("||")) {
      both();
      push(FormulaOp::logical_or);
    }
  }

  void both() {
    comparison();
    while (accept("&&")) {
      comparison();
      push(FormulaOp::logical_and);
    }
  }

  void comparison() {
    sum();
    const Operator* found = accept(kComparisons);
    if (!found) return;
    sum();
    push(found->op);
    if (accept(kComparisons)) {
      report(codes::kFormulaChained, "comparisons do not chain", "join two comparisons with &&");
      stopped_ = true;
    }
  }

  void sum() {
    product();
    while (const Operator* found = accept(kSums)) {
      product();
      push(found->op);
    }
  }

  void product() {
    sign();
    while (const Operator* found = accept(kProducts)) {
      sign();
      push(found->op);
    }
  }

  void sign() {
    const Level level(*this);
    if (stopped_) return;
    if (accept("-")) {
      sign();
      push(FormulaOp::negate);
    } else if (accept("+")) {
      sign();
    } else if (text_.substr(at_, 2) != "!=" && accept("!")) {
      sign();
      push(FormulaOp::logical_not);
    } else {
      raised();
    }
  }

  // Binds tighter than a sign before it, and may have one behind it: -2 ^ -2 is -(2 ^ (-2)).
  void raised() {
    primary();
    if (!accept("^")) return;
    sign();
    push(FormulaOp::power);
  }

  void primary() {
    if (accept("(")) {
      choice();
      if (!accept(")")) syntax("\")\" is expected");
      return;
    }
    skip_space();
    const char next = at_ < text_.size() ? text_[at_] : '\0';
    if (is_digit(next) || next == '.') return number();
    if (next == '$') return input();
    if (is_letter(next)) return name();
    syntax("a number, an attribute in braces, a function or \"(\" is expected");
  }

  void number() {
    double value = 0;
    const auto result = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (result.ec != std::errc() || !std::isfinite(value)) return syntax("a number is expected");
    at_ = static_cast<std::size_t>(result.ptr - text_.data());
    push({FormulaOp::constant, value, 0});
  }

  void input() {
    int index = 0;
    const auto result = std::from_chars(text_.data() + at_ + 1, text_.data() + text_.size(), index);
    if (result.ec != std::errc() || index < 0)
      return syntax("$ and the number of an input are expected");
    if (index >= inputs_) {
      report(codes::kFormulaInput,
             inputs_ == 0
                 ? fmt::format("there is no ${}: the expression has no inputs", index)
                 : fmt::format("there is no ${}: inputs are $0 to ${}", index, inputs_ - 1));
    }
    at_ = static_cast<std::size_t>(result.ptr - text_.data());
    push({FormulaOp::input, 0, index});
  }

  void name() {
    const std::size_t begin = at_;
    std::size_t end = at_;
    while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    const std::string_view word = text_.substr(begin, end - begin);
    at_ = end;
    if (accept("(")) return call(word, begin);
    if (word == "pi") return push({FormulaOp::constant, 3.14159265358979323846, 0});
    if (word == "e") return push({FormulaOp::constant, 2.71828182845904523536, 0});
    at_ = begin;
    std::string hint = suggest(word, {"pi", "e"});
    for (const FormulaFunction& function : formula_functions()) {
      if (function.name == word) hint = fmt::format("{} is a function: {}(...)", word, word);
    }
    report(codes::kFormulaName, fmt::format("there is no constant \"{}\"", printable(word)),
           std::move(hint));
    at_ = end;
    push({FormulaOp::constant, 0, 0});
  }

  void call(std::string_view word, std::size_t begin) {
    const auto functions = formula_functions();
    const auto found = std::find_if(functions.begin(), functions.end(),
                                    [&](const FormulaFunction& f) { return f.name == word; });
    const bool known = found != functions.end();
    if (!known) unknown_function(word, begin);
    int arguments = 0;
    if (!accept(")")) {
      do {
        choice();
        ++arguments;
        if (known && found->least != found->most && arguments >= 2) push(found->op);
      } while (accept(","));
      if (!accept(")")) return syntax("\",\" or \")\" is expected");
    }
    if (!known || stopped_) return;
    if (arguments < found->least || arguments > found->most)
      return wrong_count(*found, arguments, begin);
    if (found->least == found->most) push(found->op);
  }

  void unknown_function(std::string_view word, std::size_t begin) {
    std::vector<std::string> names;
    for (const FormulaFunction& function : formula_functions()) names.emplace_back(function.name);
    const std::size_t end = at_;
    at_ = begin;
    report(codes::kFormulaName, fmt::format("there is no function \"{}\"", printable(word)),
           suggest(word, names));
    at_ = end;
  }

  void wrong_count(const FormulaFunction& function, int arguments, std::size_t begin) {
    const std::size_t end = at_;
    at_ = begin;
    const std::string takes = function.least == function.most
                                  ? fmt::format("{}", function.least)
                                  : fmt::format("{} or more", function.least);
    report(codes::kFormulaArguments,
           fmt::format("{} takes {} argument{}, not {}", function.name, takes,
                       function.least == 1 && function.most == 1 ? "" : "s", arguments),
           fmt::format("{}: {}", function.name, function.help));
    at_ = end;
  }

  std::string_view text_;
  Span span_;
  int inputs_;
  Diagnostics& diagnostics_;
  Formula formula_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool failed_ = false;
  bool stopped_ = false;  // by an error after which the text cannot be followed
};

}  // namespace

std::optional<Formula> parse_formula(std::string_view text, const Span& span, int inputs,
                                     Diagnostics& diagnostics) {
  return FormulaParser(text, span, inputs, diagnostics).parse();
}

}  // namespace rigc::scene
