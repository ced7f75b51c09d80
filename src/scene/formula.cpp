// SPDX-License-Identifier: MIT
// A recursive descent parser for formulas; one function a level of precedence, loosest first:
// ?:  ||  &&  comparison  + -  * / %  unary - !  ^ (right to left)  members  primary. Each gives
// the step whose value it has parsed.
// Test: tests/scene/formula_test.cpp
#include "scene/formula.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include <fmt/format.h>
#include "base/text.h"
#include "scene/codes.h"
#include "scene/formula_text.h"
#include "scene/formula_types.h"

namespace rigc::scene {

namespace {

constexpr std::size_t kMaxSteps = 10000;

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

/// A step's value.
struct Value {
  int step = 0;
  Type type = Type::number;
};

class FormulaParser : FormulaText {
 public:
  FormulaParser(std::string_view text, const Span& span, int inputs, Diagnostics& diagnostics)
      : FormulaText(text, span, diagnostics), inputs_(inputs) {}

  std::optional<Formula> parse() {
    if (is_too_long()) return std::nullopt;
    const Value value = choice();
    skip_space();
    if (!stopped_ && at_ < text_.size()) syntax("an operator is expected");
    if (!stopped_) expect(value, Type::number, "an expression");
    if (failed_) return std::nullopt;
    formula_.result = value.step;
    return std::move(formula_);
  }

  std::optional<Formula> parse_statements() {
    if (is_too_long()) return std::nullopt;
    while (!stopped_) {
      skip_space();
      if (at_ >= text_.size()) break;
      statement();
    }
    if (failed_) return std::nullopt;
    return std::move(formula_);
  }

 private:
  template <std::size_t n>
  const Operator* accept(const Operator (&operators)[n]) {
    for (const Operator& candidate : operators) {
      if (accept(candidate.text)) return &candidate;
    }
    return nullptr;
  }
  using FormulaText::accept;

  Value push(Formula::Step step) {
    if (stopped_) return {};
    if (formula_.steps.size() >= kMaxSteps) {
      report(codes::kFormulaTooLarge, "the expression has too many operations");
      stopped_ = true;
      return {};
    }
    formula_.steps.push_back(step);
    return {static_cast<int>(formula_.steps.size()) - 1, step.type};
  }
  Value constant(double value) {
    Formula::Step step;
    step.value = value;
    return push(step);
  }
  Value push(FormulaOp op, Type type, std::initializer_list<Value> arguments, int first = 0) {
    Formula::Step step{op, 0, first, type, {-1, -1, -1}};
    std::size_t i = 0;
    for (const Value& argument : arguments) step.arguments[i++] = argument.step;
    return push(step);
  }

  bool expect(const Value& value, Type type, std::string_view what) {
    if (stopped_ || value.type == type) return true;
    wrong_type(
        fmt::format("{} takes a {}, not a {}", what, formula_type(type), formula_type(value.type)));
    return false;
  }
  void wrong_type(const std::string& message) {
    report(codes::kFormulaType, message);
    stopped_ = true;
  }

  /// An operator of numbers, or what it means for other types.
  Value binary(FormulaOp op, Value left, Value right) {
    if (left.type == Type::number && right.type == Type::number)
      return push(op, Type::number, {left, right});
    if (op == FormulaOp::multiply && left.type == Type::number && right.type == Type::vec3)
      std::swap(left, right);
    if (op == FormulaOp::divide && left.type == Type::vec3 && right.type == Type::number) {
      const Value one = constant(1);
      right = push(FormulaOp::divide, Type::number, {one, right});
      op = FormulaOp::multiply;
    }
    if (const Overload* meant = overload(op, left.type, right.type))
      return push(meant->means, meant->result, {left, right});
    if (!stopped_) {
      wrong_type(fmt::format("there is no {} of a {} and a {}", name_of(op),
                             formula_type(left.type), formula_type(right.type)));
    }
    return {};
  }

  Value choice() {
    const Level level(*this);
    const Value condition = either();
    if (!accept("?")) return condition;
    const Value where_true = choice();
    if (!accept(":")) return syntax("\":\" is expected"), Value{};
    return select(condition, where_true, choice());
  }

  Value select(const Value& condition, const Value& where_true, const Value& where_false) {
    if (!expect(condition, Type::number, "a condition")) return {};
    if (where_true.type != where_false.type && !stopped_) {
      wrong_type(fmt::format("a choice between a {} and a {}", formula_type(where_true.type),
                             formula_type(where_false.type)));
      return {};
    }
    const bool numbers = where_true.type == Type::number;
    return push(numbers ? FormulaOp::select : FormulaOp::choose, where_true.type,
                {condition, where_true, where_false});
  }

  Value either() {
    Value left = both();
    while (accept("||")) left = binary(FormulaOp::logical_or, left, both());
    return left;
  }

  Value both() {
    Value left = comparison();
    while (accept("&&")) left = binary(FormulaOp::logical_and, left, comparison());
    return left;
  }

  Value comparison() {
    const Value left = sum();
    const Operator* found = accept(kComparisons);
    if (!found) return left;
    const Value compared = binary(found->op, left, sum());
    if (accept(kComparisons)) {
      report(codes::kFormulaChained, "comparisons do not chain", "join two comparisons with &&");
      stopped_ = true;
    }
    return compared;
  }

  Value sum() {
    Value left = product();
    while (const Operator* found = accept(kSums)) left = binary(found->op, left, product());
    return left;
  }

  Value product() {
    Value left = sign();
    while (const Operator* found = accept(kProducts)) left = binary(found->op, left, sign());
    return left;
  }

  Value sign() {
    const Level level(*this);
    if (stopped_) return {};
    if (accept("-")) return negated(sign());
    if (accept("+")) return sign();
    if (text_.substr(at_, 2) != "!=" && accept("!")) {
      const Value value = sign();
      if (!expect(value, Type::number, "!")) return {};
      return push(FormulaOp::logical_not, Type::number, {value});
    }
    return raised();
  }

  Value negated(const Value& value) {
    if (value.type == Type::vec3) {
      const Value minus = constant(-1);
      return push(FormulaOp::vector_scale, Type::vec3, {value, minus});
    }
    if (!expect(value, Type::number, "-")) return {};
    return push(FormulaOp::negate, Type::number, {value});
  }

  // Binds tighter than a sign before it, and may have one behind it: -2 ^ -2 is -(2 ^ (-2)).
  Value raised() {
    const Value base = members(primary());
    if (!accept("^")) return base;
    return binary(FormulaOp::power, base, sign());
  }

  Value members(Value value) {
    while (!stopped_ && at_ + 1 < text_.size() && text_[at_] == '.' && is_letter(text_[at_ + 1])) {
      ++at_;
      const std::size_t begin = at_;
      const std::string_view name = word();
      const Member* found = member(value.type, name);
      if (!found) {
        at_ = begin;
        report(codes::kFormulaName,
               fmt::format("a {} has no \"{}\"", formula_type(value.type), printable(name)));
        stopped_ = true;
        return {};
      }
      value = push(FormulaOp::component, found->type, {value}, found->first);
    }
    return value;
  }

  Value primary() {
    if (accept("(")) {
      const Value value = choice();
      if (!accept(")")) syntax("\")\" is expected");
      return value;
    }
    skip_space();
    const char next = at_ < text_.size() ? text_[at_] : '\0';
    if (is_digit(next) || next == '.') return number();
    if (next == '$') return input();
    if (is_letter(next)) return name();
    syntax("a number, an attribute in braces, a function or \"(\" is expected");
    return {};
  }

  Value number() {
    double value = 0;
    const auto result = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (result.ec != std::errc() || !std::isfinite(value))
      return syntax("a number is expected"), Value{};
    at_ = static_cast<std::size_t>(result.ptr - text_.data());
    return constant(value);
  }

  Value input() {
    int index = 0;
    const auto result = std::from_chars(text_.data() + at_ + 1, text_.data() + text_.size(), index);
    if (result.ec != std::errc() || index < 0)
      return syntax("$ and the number of an input are expected"), Value{};
    if (index >= inputs_) {
      report(codes::kFormulaInput,
             inputs_ == 0
                 ? fmt::format("there is no ${}: the expression has no inputs", index)
                 : fmt::format("there is no ${}: inputs are $0 to ${}", index, inputs_ - 1));
    }
    at_ = static_cast<std::size_t>(result.ptr - text_.data());
    return push(FormulaOp::input, Type::number, {}, index);
  }

  Value name() {
    const std::size_t begin = at_;
    const std::string_view name = word();
    const std::size_t end = at_;
    if (accept("(")) return call(name, begin);
    at_ = end;
    for (const auto& [known, value] : named_) {
      if (known == name) return value;
    }
    if (name == "pi") return constant(3.14159265358979323846);
    if (name == "e") return constant(2.71828182845904523536);
    at_ = begin;
    report(codes::kFormulaName, fmt::format("there is no constant \"{}\"", printable(name)),
           suggestion(name));
    at_ = end;
    return constant(0);
  }

  std::string suggestion(std::string_view name) {
    for (const FormulaFunction& function : formula_functions()) {
      if (function.name == name) return fmt::format("{} is a function: {}(...)", name, name);
    }
    std::vector<std::string> names{"pi", "e"};
    for (const auto& [known, value] : named_) names.emplace_back(known);
    return suggest(name, names);
  }

  Value call(std::string_view word, std::size_t begin) {
    const auto functions = formula_functions();
    const auto found = std::find_if(functions.begin(), functions.end(),
                                    [&](const FormulaFunction& f) { return f.name == word; });
    const bool folds = found != functions.end() && found->least != found->most;
    std::vector<Value> arguments;
    int count = 0;
    if (!accept(")")) {
      do {
        arguments.push_back(choice());
        ++count;
        if (folds && arguments.size() >= 2) fold(found->op, arguments);
      } while (accept(","));
      if (!accept(")")) return syntax("\",\" or \")\" is expected"), Value{};
    }
    if (stopped_) return {};
    if (const auto typed = typed_call(word, arguments)) return *typed;
    if (found == functions.end()) return unknown_function(word, arguments, begin);
    if (count < found->least || count > found->most) return wrong_count(*found, count, begin);
    if (folds) return arguments.front();
    if (found->op == FormulaOp::select) return select(arguments[0], arguments[1], arguments[2]);
    for (const Value& argument : arguments) {
      if (!expect(argument, Type::number, word)) return {};
    }
    return push_call(found->op, Type::number, arguments);
  }

  /// min and max of any number: two at a time.
  void fold(FormulaOp op, std::vector<Value>& arguments) {
    arguments[0] = binary(op, arguments[0], arguments[1]);
    arguments.pop_back();
  }

  Value push_call(FormulaOp op, Type type, const std::vector<Value>& arguments) {
    Formula::Step step{op, 0, 0, type, {-1, -1, -1}};
    for (std::size_t i = 0; i < arguments.size(); ++i) step.arguments[i] = arguments[i].step;
    return push(step);
  }

  /// A function of values that are not all numbers, by its name and the types.
  std::optional<Value> typed_call(std::string_view word, const std::vector<Value>& arguments) {
    const auto is = [&](std::initializer_list<Type> types) {
      return std::equal(arguments.begin(), arguments.end(), types.begin(), types.end(),
                        [](const Value& a, Type type) { return a.type == type; });
    };
    if (word == "distance" && is({Type::vec3, Type::vec3})) {
      const Value way = binary(FormulaOp::subtract, arguments[0], arguments[1]);
      return push(FormulaOp::length, Type::number, {way});
    }
    if (word == "swing" && is({Type::quat, Type::vec3})) {
      const Value angle = push(FormulaOp::twist_angle, Type::number, {arguments[0], arguments[1]});
      const Value back = push(FormulaOp::negate, Type::number, {angle});
      const Value turn = push(FormulaOp::axis_angle, Type::quat, {arguments[1], back});
      return push(FormulaOp::rotation_multiply, Type::quat, {arguments[0], turn});
    }
    const auto functions = typed_functions();
    const auto found = std::find_if(functions.begin(), functions.end(), [&](const auto& f) {
      return f.name == word &&
             std::equal(arguments.begin(), arguments.end(), f.arguments.begin(),
                        f.arguments.begin() + static_cast<std::ptrdiff_t>(f.count),
                        [](const Value& a, Type type) { return a.type == type; });
    });
    if (found == functions.end()) return std::nullopt;
    return push_call(found->op, found->result, arguments);
  }

  Value unknown_function(std::string_view word, const std::vector<Value>& arguments,
                         std::size_t begin) {
    std::vector<std::string> names{"distance", "swing"};
    for (const FormulaFunction& function : formula_functions()) names.emplace_back(function.name);
    for (const TypedFunction& function : typed_functions()) names.emplace_back(function.name);
    const std::size_t end = at_;
    at_ = begin;
    if (std::find(names.begin(), names.end(), word) != names.end()) {
      std::string given;
      for (const Value& argument : arguments)
        given += fmt::format("{}{}", given.empty() ? "" : ", ", formula_type(argument.type));
      wrong_type(fmt::format("there is no {}({})", word, given));
    } else {
      report(codes::kFormulaName, fmt::format("there is no function \"{}\"", printable(word)),
             suggest(word, names));
    }
    at_ = end;
    return constant(0);
  }

  Value wrong_count(const FormulaFunction& function, int arguments, std::size_t begin) {
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
    return constant(0);
  }

  // Programs.

  void statement() {
    const bool letter = is_letter(text_[at_]);
    const std::size_t begin = at_;
    std::string_view first = letter ? word() : std::string_view{};
    if (first == "in") {
      declare_inputs();
    } else if (letter) {
      const bool gives = first == "out";
      if (gives) first = next_word();
      define(first, begin, gives);
    } else {
      syntax("a name is expected");
    }
    if (!stopped_ && !accept(";")) syntax("\";\" is expected");
  }

  std::string_view next_word() {
    skip_space();
    if (at_ < text_.size() && is_letter(text_[at_])) return word();
    syntax("a name is expected");
    return {};
  }

  void declare_inputs() {
    do {
      const std::size_t begin = at_;
      const std::string_view name = next_word();
      if (!accept(":")) syntax("\":\" and a type are expected");
      const std::string_view type_name = next_word();
      if (stopped_) return;
      const auto type = parse_formula_type(type_name);
      if (!type) return syntax("number, vector, rotation or matrix is expected");
      const int element = count_of(formula_.inputs, *type);
      const Value value = push(FormulaOp::input, *type, {}, element);
      formula_.inputs.push_back({std::string(name), value.type, element, value.step});
      add_name(name, value, begin);
    } while (!stopped_ && accept(","));
  }

  void define(std::string_view name, std::size_t begin, bool gives) {
    if (!stopped_ && !accept("=")) syntax("\"=\" is expected");
    if (stopped_) return;
    const Value value = choice();
    if (stopped_) return;
    if (gives) {
      const int element = count_of(formula_.outputs, value.type);
      formula_.outputs.push_back({std::string(name), value.type, element, value.step});
    }
    add_name(name, value, begin);
  }

  void add_name(std::string_view name, const Value& value, std::size_t begin) {
    for (const auto& [known, other] : named_) {
      if (known != name) continue;
      at_ = begin;
      report(codes::kFormulaName, fmt::format("\"{}\" is there already", name));
      stopped_ = true;
      return;
    }
    named_.emplace_back(name, value);
  }

  static int count_of(const std::vector<Formula::Named>& named, Type type) {
    return static_cast<int>(
        std::count_if(named.begin(), named.end(), [&](const auto& n) { return n.type == type; }));
  }

  int inputs_;
  Formula formula_;
  std::vector<std::pair<std::string_view, Value>> named_;  // of a program
};

}  // namespace

std::optional<Formula> parse_formula(std::string_view text, const Span& span, int inputs,
                                     Diagnostics& diagnostics) {
  return FormulaParser(text, span, inputs, diagnostics).parse();
}

std::optional<Formula> parse_program(std::string_view text, const Span& span,
                                     Diagnostics& diagnostics) {
  return FormulaParser(text, span, 0, diagnostics).parse_statements();
}

}  // namespace rigc::scene
