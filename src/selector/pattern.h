// SPDX-License-Identifier: MIT
// The grammar of selectors as a regular expression, for JSON Schemas. Test:
// tests/selector/pattern_test.cpp
#pragma once

#include <string>

namespace rigc::selector {

enum class Wanted { node, plug };

/// An ECMAScript regular expression for the whole of a selector that names nodes (no attribute) or
/// plugs (an attribute in every choice). It takes indices of any size; else it takes what parse()
/// takes.
std::string pattern(Wanted wanted);

}  // namespace rigc::selector
