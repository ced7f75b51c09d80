// SPDX-License-Identifier: MIT
// Diagnostic codes 400..419: formulas.
// Test: every code is provoked in tests/scene/formula_test.cpp.
#pragma once

#include "base/diagnostics.h"

namespace rigc::scene::codes {

inline constexpr Code kFormulaSyntax{
    400, Severity::error, "expression is not well formed",
    "An expression has numbers, plugs, the operators + - * / % ^ < <= > >= == != && || ! ?: and "
    "functions with their arguments in parentheses."};
inline constexpr Code kFormulaName{
    401, Severity::error, "unknown name in an expression",
    "Names in expressions are functions and the constants pi and e. Attributes stand in braces: "
    "{arm_l/control@size}."};
inline constexpr Code kFormulaArguments{
    402, Severity::error, "wrong number of arguments in an expression",
    "The function takes another number of arguments; the message says how many."};
inline constexpr Code kFormulaInput{
    403, Severity::error, "no such input of an expression",
    "$0 is the first input, $1 the second; the expression names more inputs than there are."};
inline constexpr Code kFormulaTooLarge{404, Severity::error, "expression is too large",
                                       "An expression nests at most 100 deep and has at most "
                                       "10,000 operations. Split it into several."};
inline constexpr Code kFormulaChained{
    405, Severity::error, "chained comparison",
    "Write `a < b && b < c`: `a < b < c` would compare c with 0 or 1."};

inline constexpr Code kFormulaType{
    406, Severity::error, "values of these types do not go together",
    "Numbers, vectors, rotations and matrices have operators and functions of their own; the "
    "message says what was given."};

inline constexpr const Code* kSceneCodes[] = {
    &kFormulaSyntax,   &kFormulaName,    &kFormulaArguments, &kFormulaInput,
    &kFormulaTooLarge, &kFormulaChained, &kFormulaType};

}  // namespace rigc::scene::codes
