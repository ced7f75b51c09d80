// SPDX-License-Identifier: MIT
// Values as YAML text that reads back as the same values: for templates that rigc writes.
// Test: tests/templates/write_test.cpp
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/literal.h"
#include "math/math.h"

namespace rigc::templates {

/// A text without quotes where YAML, in block or flow, takes it for this very text; else quoted.
std::string yaml_text(std::string_view text);
/// `[a, b]`; a single text without brackets.
std::string yaml_texts(const std::vector<std::string>& texts);
/// Numbers by the shortest text that reads back as the same double.
std::string yaml_numbers(const double* numbers, std::size_t count);
std::string yaml_vector(const math::Vec3& vector);
/// Lists and maps in one line.
std::string yaml_text(const Literal& literal);

}  // namespace rigc::templates
