// SPDX-License-Identifier: MIT
// What the attribute modules share: may a plug be set or connected into.
// Test: tests/modules/attributes_test.cpp
#pragma once

#include "modules/builder.h"

namespace rigc::modules {

/// Fails where the plug is an output or data.
bool check_input(Builder& b, const Plug& plug, std::string_view parameter);

/// Fails where the plug does not carry a number.
bool check_number(Builder& b, const Plug& plug, std::string_view parameter);

}  // namespace rigc::modules
