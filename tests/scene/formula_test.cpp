// SPDX-License-Identifier: MIT
// Formulas: postfix lists for texts, every diagnostic, and random garbage that must not crash.
#include "scene/formula.h"

#include <doctest/doctest.h>

#include <fmt/format.h>

#include "scene/codes.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using scene::FormulaOp;

std::string postfix(std::string_view text, int inputs = 3) {
  Diagnostics diagnostics;
  const auto formula = scene::parse_formula(text, {}, inputs, diagnostics);
  REQUIRE(formula.has_value() == diagnostics.ok());
  if (!formula) return diagnostics.all().front().message;
  std::string out;
  for (const auto& step : formula->steps) {
    if (!out.empty()) out += ' ';
    if (step.op == FormulaOp::constant) {
      out += fmt::format("{}", step.value);
    } else if (step.op == FormulaOp::input) {
      out += fmt::format("${}", step.input);
    } else {
      out += scene::name_of(step.op);
    }
  }
  return out;
}

const Code* error_of(std::string_view text, int inputs = 3) {
  Diagnostics diagnostics;
  CHECK(!scene::parse_formula(text, {}, inputs, diagnostics));
  REQUIRE(!diagnostics.all().empty());
  return diagnostics.all().front().code;
}

TEST_CASE("scene formula: precedence") {
  CHECK(postfix("1 + 2 * 3") == "1 2 3 multiply add");
  CHECK(postfix("(1 + 2) * 3") == "1 2 add 3 multiply");
  CHECK(postfix("1 - 2 - 3") == "1 2 subtract 3 subtract");
  CHECK(postfix("8 / 4 / 2") == "8 4 divide 2 divide");
  CHECK(postfix("7 % 4 * 2") == "7 4 modulo 2 multiply");
  CHECK(postfix("2 ^ 3 ^ 2") == "2 3 2 power power");
  CHECK(postfix("-2 ^ 2") == "2 2 power negate");
  CHECK(postfix("2 ^ -1") == "2 1 negate power");
  CHECK(postfix("-$0 * $1") == "$0 negate $1 multiply");
  CHECK(postfix("1 - -1") == "1 1 negate subtract");
  CHECK(postfix("1 + 2 < 4") == "1 2 add 4 less");
  CHECK(postfix("1 < 2 && 3 >= 2 || !0") == "1 2 less 3 2 greater_equal and 0 not or");
  CHECK(postfix("$0 != 1") == "$0 1 not_equal");
  CHECK(postfix("$0 ? 1 : $1 ? 2 : 3") == "$0 1 $1 2 3 select select");
}

TEST_CASE("scene formula: numbers, constants and functions") {
  CHECK(postfix(" 1.5e1 ") == "15");
  CHECK(postfix(".5") == "0.5");
  CHECK(postfix("pi") == "3.141592653589793");
  CHECK(postfix("e*1") == "2.718281828459045 1 multiply");
  CHECK(postfix("sin($0)") == "$0 sin");
  CHECK(postfix("atan2(1, 2)") == "1 2 atan2");
  CHECK(postfix("min(1, 2, 3)") == "1 2 min 3 min");
  CHECK(postfix("max($0,$1)") == "$0 $1 max");
  CHECK(postfix("if(1, 2, 3)") == "1 2 3 select");
  CHECK(postfix("clamp(lerp(0,1,$2), 0, 1)") == "0 1 $2 lerp 0 1 clamp");
  CHECK(postfix("mod(5, 3) + pow(2, 3)") == "5 3 modulo 2 3 power add");
}

TEST_CASE("scene formula: every function parses with its number of arguments") {
  for (const scene::FormulaFunction& function : scene::formula_functions()) {
    std::string text = std::string(function.name) + "(1";
    for (int i = 1; i < function.least; ++i) text += ", 1";
    CHECK(postfix(text + ")").find(' ') != std::string::npos);
    CHECK(!function.help.empty());
  }
}

TEST_CASE("scene formula: syntax errors say where") {
  CHECK(postfix("1 +") ==
        "a number, an attribute in braces, a function or \"(\" is expected, but it ends, at column "
        "4 of \"1 +\"");
  CHECK(postfix("(1 + 2") == "\")\" is expected, but it ends, at column 7 of \"(1 + 2\"");
  for (const char* text : {"",      "  ",       "1 2", "* 2",   "1 + * 2", "()",    "min(1 2)",
                           "1 ? 2", "1 ? 2 : ", "$",   "$x",    "1e",      "1 = 2", "1 & 1",
                           "a b",   "#",        "1)",  "1e999", "{size}",  "..",    "\xff"}) {
    CAPTURE(text);
    const Code* code = error_of(text);
    CHECK((code == &scene::codes::kFormulaSyntax || code == &scene::codes::kFormulaName));
  }
  CHECK(error_of("1 +") == &scene::codes::kFormulaSyntax);
}

TEST_CASE("scene formula: unknown names, with hints") {
  Diagnostics diagnostics;
  CHECK(!scene::parse_formula("sine(1) + clam(1, 2, 3) + sin + foo", {}, 0, diagnostics));
  REQUIRE(diagnostics.errors() == 4);
  for (const Diagnostic& d : diagnostics.all()) CHECK(d.code == &scene::codes::kFormulaName);
  CHECK(diagnostics.all()[0].hint.find("sin") != std::string::npos);
  CHECK(diagnostics.all()[1].hint.find("clamp") != std::string::npos);
  CHECK(diagnostics.all()[2].hint == "sin is a function: sin(...)");
}

TEST_CASE("scene formula: arguments, inputs, chains and size") {
  CHECK(error_of("sin()") == &scene::codes::kFormulaArguments);
  CHECK(error_of("sin(1, 2)") == &scene::codes::kFormulaArguments);
  CHECK(error_of("min(1)") == &scene::codes::kFormulaArguments);
  CHECK(error_of("clamp(1, 2)") == &scene::codes::kFormulaArguments);
  CHECK(error_of("$3") == &scene::codes::kFormulaInput);
  CHECK(error_of("$0", 0) == &scene::codes::kFormulaInput);
  CHECK(error_of("$99999999999999") == &scene::codes::kFormulaSyntax);
  CHECK(error_of("1 < 2 < 3") == &scene::codes::kFormulaChained);
  CHECK(error_of(std::string(200, '(') + "1" + std::string(200, ')')) ==
        &scene::codes::kFormulaTooLarge);
  CHECK(error_of(std::string(99999, '-') + "1") == &scene::codes::kFormulaTooLarge);
  CHECK(error_of(std::string(100001, ' ')) == &scene::codes::kFormulaTooLarge);
  std::string sum = "1";
  for (int i = 0; i < 4000; ++i) sum += "+1";
  CHECK(postfix(sum).size() > 4000);
  for (int i = 0; i < 4000; ++i) sum += "+1";
  CHECK(error_of(sum) == &scene::codes::kFormulaTooLarge);
}

TEST_CASE("scene formula: random texts never crash and always say why") {
  const std::string_view pieces[] = {"1", "$0",   "(",    ")",   "+",  "-",  "*",  "^",
                                     "<", "==",   "!",    "?",   ":",  ",",  "pi", " ",
                                     "%", "sin(", "min(", "if(", "&&", "||", "x",  "."};
  test::Random random(7);
  int good = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string text;
    for (std::size_t n = 1 + random.below(9); n > 0; --n)
      text += pieces[random.below(std::size(pieces))];
    Diagnostics diagnostics;
    const auto formula = scene::parse_formula(text, {}, 1, diagnostics);
    REQUIRE(formula.has_value() == diagnostics.ok());
    if (!formula) continue;
    ++good;
    // The steps leave one value on the stack and never take more than there are.
    int depth = 0;
    for (const auto& step : formula->steps) {
      depth -= scene::arity(step.op);
      REQUIRE(depth >= 0);
      ++depth;
    }
    REQUIRE(depth == 1);
  }
  CHECK(good > 1000);
}

// --- programs ---

std::string shape(std::string_view text) {
  Diagnostics diagnostics;
  const auto program = scene::parse_program(text, {}, diagnostics);
  REQUIRE(program.has_value() == diagnostics.ok());
  if (!program) return diagnostics.all().front().message;
  std::string out;
  for (const auto* list : {&program->inputs, &program->outputs}) {
    for (const auto& named : *list)
      out += fmt::format("{}:{}{} ", named.name, scene::name_of(named.type), named.element);
    out += "| ";
  }
  for (const auto& step : program->steps) {
    if (step.op >= FormulaOp::negate) out += std::string(scene::name_of(step.op)) + " ";
  }
  return out;
}

TEST_CASE("scene formula: programs name what they take and give") {
  CHECK(shape("in a: number, m: matrix, b: number; out c = a + b; out at = m.origin * c;") ==
        "a:number0 m:matrix0 b:number1 | c:number0 at:vec30 | add component vector_scale ");
  CHECK(shape("in v: vector; half = v / 2; out w = half - 3 * v;") ==
        "v:vec30 | w:vec30 | divide vector_scale vector_scale vector_subtract ");
  CHECK(shape("") == "| | ");
  CHECK(shape("in q: rotation; out s = swing(q, vector(0, 1, 0));") ==
        "q:quat0 | s:quat0 | gather twist_angle negate axis_angle rotation_multiply ");
}

TEST_CASE("scene formula: what operators mean depends on the types") {
  const std::string takes = "in n: number, v: vector, q: rotation, m: matrix; out r = ";
  for (const auto& [text_of, op] : {std::pair{"v + v", "vector_add"},
                                    {"n * v", "vector_scale"},
                                    {"q * q", "rotation_multiply"},
                                    {"q * v", "rotation_apply"},
                                    {"m * m", "matrix_multiply"},
                                    {"m * v", "transform_point"},
                                    {"n > 0 ? v : v", "choose"},
                                    {"if(n, m, m)", "choose"},
                                    {"inverse(q)", "rotation_inverse"},
                                    {"inverse(m)", "matrix_inverse"},
                                    {"lerp(v, v, n)", "vector_lerp"},
                                    {"-v", "vector_scale"},
                                    {"distance(v, v)", "length"}}) {
    const std::string text(text_of);
    CAPTURE(text);
    CHECK(shape(takes + text + ";").find(op) != std::string::npos);
  }
}

TEST_CASE("scene formula: programs refuse what does not go together") {
  const std::string takes = "in n: number, v: vector, q: rotation, m: matrix; ";
  for (const std::string text :
       {"out r = v * v;", "out r = v + n;", "out r = v < v;", "out r = !m;", "out r = -q;",
        "out r = n ? v : q;", "out r = v ? n : n;", "out r = sin(v);", "out r = dot(v, n);",
        "out r = q + q;", "out r = length(m);"}) {
    CAPTURE(text);
    Diagnostics diagnostics;
    CHECK(!scene::parse_program(takes + text, {}, diagnostics));
    CHECK(diagnostics.all().front().code == &scene::codes::kFormulaType);
  }
  for (const std::string text : {"out n = 1;", "r = 1; r = 2;", "out r = v.w;", "out r = q.x;",
                                 "out r = x;", "out r = crossed(v, v);"}) {
    CAPTURE(text);
    Diagnostics diagnostics;
    CHECK(!scene::parse_program(takes + text, {}, diagnostics));
    CHECK(diagnostics.all().front().code == &scene::codes::kFormulaName);
  }
  for (const std::string text : {"out r = 1", "out = 1;", "in a;", "in a: colour;", "1;", "out r;",
                                 "in a: number b: number;", "out 1 = 2;", "in;"}) {
    CAPTURE(text);
    Diagnostics diagnostics;
    CHECK(!scene::parse_program(text, {}, diagnostics));
    CHECK(diagnostics.all().front().code == &scene::codes::kFormulaSyntax);
  }
}

TEST_CASE("scene formula: every typed function is found by its name and types") {
  const std::string takes = "in n: number, v: vector, q: rotation, m: matrix; out r = ";
  for (const scene::TypedFunction& f : scene::typed_functions()) {
    std::string text(f.name);
    for (std::size_t i = 0; i < f.count; ++i)
      text += (i == 0 ? "(" : ", ") + std::string(1, "nvqm"[static_cast<int>(f.arguments[i])]);
    CAPTURE(text);
    CHECK(shape(takes + text + ");").find(scene::name_of(f.op)) != std::string::npos);
    CHECK(!f.help.empty());
  }
}

TEST_CASE("scene formula: random programs never crash and always say why") {
  const std::string_view pieces[] = {
      "in ", "a",   "b", "c", ": number", ": vector", ": matrix", ",",  ";",  "out ", "=",    "+",
      "*",   "a.x", "(", ")", "dot(",     "1",        "swing(",   "? ", ": ", "if(",  "min(", " "};
  test::Random random(11);
  int good = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string text = "in a: vector, b: number;";
    for (std::size_t n = 1 + random.below(9); n > 0; --n)
      text += pieces[random.below(std::size(pieces))];
    Diagnostics diagnostics;
    const auto program = scene::parse_program(text, {}, diagnostics);
    REQUIRE(program.has_value() == diagnostics.ok());
    if (!program) continue;
    ++good;
    for (std::size_t s = 0; s < program->steps.size(); ++s) {
      for (const int argument : program->steps[s].arguments)
        REQUIRE(argument < static_cast<int>(s));
    }
  }
  CHECK(good > 100);
}

}  // namespace
}  // namespace rigc
