// SPDX-License-Identifier: MIT
// JSON Schema of parameters: what a command's `with:` takes, what the default of a template's
// parameter may be. Test: tests/pipeline/schema_test.cpp
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "base/json.h"
#include "catalog/descriptor.h"

namespace rigc::pipeline {

/// A name as a regular expression, without `^` and `$`.
inline constexpr std::string_view kNamePattern = "[A-Za-z_][A-Za-z0-9_-]*";
/// `$name`, which stands for the value of a template's parameter.
inline constexpr std::string_view kPlaceholderPattern = R"(\$[A-Za-z_][A-Za-z0-9_-]*)";

/// Members of an open schema object: `type`, one or several.
void write_types(json::Writer& w, std::initializer_list<const char*> types);
/// Members: the whole of a text fits `pattern`, else an editor says `message`.
void write_pattern(json::Writer& w, std::string_view pattern, std::string_view message);
/// Members: what people read, Markdown.
void write_description(json::Writer& w, std::string_view markdown);

/// Members: the values that a parameter takes; with `placeholders` also `$name` in their place.
void write_parameter_values(json::Writer& w, const catalog::Parameter& parameter,
                            bool placeholders);

/// A schema object of a command's `with:`. Values may be `$name`.
void write_arguments(json::Writer& w, const catalog::Descriptor& descriptor);

}  // namespace rigc::pipeline
