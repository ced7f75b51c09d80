// SPDX-License-Identifier: MIT
// Diagnostic codes 150..199: selectors and the selectors inside expressions.
// Test: every code is provoked by tests/selector/parse_test.cpp or expression_test.cpp.
#pragma once

#include "base/diagnostics.h"

namespace rigc::selector::codes {

inline constexpr Code kEmpty{
    150, Severity::error, "empty selector",
    "A selector says which node is meant: `.` is this joint, `arm_l.elbow` a labelled joint, "
    "`./control` this joint's control. An empty choice beside `|` says nothing."};
inline constexpr Code kSyntax{151, Severity::error, "selector syntax",
                              "The selector is not written as docs/selectors.md says. The caret "
                              "shows where; the message says "
                              "what may stand there."};
inline constexpr Code kBadName{
    152, Severity::error, "bad name in a selector",
    "Names of groups, labels, modules, ids, roles, kinds and attributes have letters, digits, `_` "
    "and `-`, do not start with a digit or `-`, and have at most 255 characters."};
inline constexpr Code kBadIndex{
    153, Severity::error, "bad index in a selector",
    "Indices are whole numbers from 0, negative ones counting from the end, ranges such as 1..3, "
    "START, MIDDLE, END, or `*` for all."};
inline constexpr Code kBadComponent{154, Severity::error, "no such component",
                                    "A vector has the components x, y and z, a rotation also w."};
inline constexpr Code kSelfOfOtherRig{
    155, Severity::error, "this joint is not in another rig",
    "`.` and `..` are this joint and its parent; they cannot follow the name of another rig. "
    "Name a local group of that rig."};
inline constexpr Code kMixedChoices{
    156, Severity::error, "choices of different sorts",
    "Either every choice between `|` names an attribute or none does: a parameter takes attributes "
    "or nodes, not both."};
inline constexpr Code kEmptyExpression{
    157, Severity::error, "empty expression",
    "The expression has no text. Write a number or a formula, such as `{./control@roll} * 2`."};
inline constexpr Code kUnbalancedBrace{
    158, Severity::error, "unbalanced brace",
    "In an expression every attribute stands between `{` and `}`, and braces are not nested."};
inline constexpr Code kNotAPlug{
    159, Severity::error, "node instead of an attribute",
    "Between the braces of an expression stands an attribute, such as `{./control@translate.x}`; a "
    "node has no value by itself."};

inline constexpr const Code* kSelectorCodes[] = {
    &kEmpty,          &kSyntax,       &kBadName,         &kBadIndex,        &kBadComponent,
    &kSelfOfOtherRig, &kMixedChoices, &kEmptyExpression, &kUnbalancedBrace, &kNotAPlug};

}  // namespace rigc::selector::codes
