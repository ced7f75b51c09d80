// SPDX-License-Identifier: MIT
// What the attribute modules share: may a plug be set or connected into, does a
// value fit, and giving it.
// Test: tests/modules/attributes_test.cpp
#pragma once

#include "modules/builder.h"

namespace rigc::modules {

/// Fails where the plug is an output or data.
bool check_input(Builder& b, const Plug& plug, std::string_view parameter);

/// Fails where the plug does not carry a number.
bool check_number(Builder& b, const Plug& plug, std::string_view parameter);

/// Why a number cannot be the value of an attribute: not of its type, or outside its range. Empty
/// where it can.
std::string why_unfit(const scene::UserAttribute& attribute, double value);

/// Gives an input that nothing drives the value of a parameter; fails where it does not fit.
bool give_value(Builder& b, const Plug& plug, std::string_view parameter);

}  // namespace rigc::modules
