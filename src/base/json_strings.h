// SPDX-License-Identifier: MIT
// The inside of JSON strings, shared by the parser and the lookups.
// Test: tests/base/json_test.cpp
#pragma once

#include <string>
#include <string_view>

namespace rigc::json {

/// A checked string without its quotes, escapes resolved.
std::string unescape(std::string_view text);

}  // namespace rigc::json
