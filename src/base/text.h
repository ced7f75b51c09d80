// SPDX-License-Identifier: MIT
// Text: numbers by one grammar, names, printing of hostile strings, "did you mean".
// Test: tests/base/text_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rigc {

/// A finite decimal number by std::from_chars (also with a leading `+`); the whole text or nothing.
std::optional<double> parse_number(std::string_view text);
std::optional<long long> parse_integer(std::string_view text);

/// The shortest text that reads back as the same number; `-0` is written `0`, integers without a
/// point.
std::string number_text(double value);

/// Letters, digits, `_` and `-`, not starting with a digit or `-`; at most 255 bytes.
bool is_name(std::string_view text);

/// Well-formed UTF-8: no overlong forms, surrogates or values above U+10FFFF.
bool is_utf8(std::string_view text);

/// Control characters (C0, C1, DEL, bidi controls) and bytes that are no UTF-8 as `\x1b`; cut to
/// `limit` bytes with `...`.
std::string printable(std::string_view text, std::size_t limit = 200);

/// The candidate nearest to `word`, if it is near enough to be a slip of the keyboard; ties go to
/// the first.
std::optional<std::string> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// `did you mean "x"?`, or what there is (at most 8): `one of a, b, c`; empty for no candidates.
std::string suggest(std::string_view word, const std::vector<std::string>& candidates);

std::vector<std::string_view> split(std::string_view text, char separator);
std::string join(const std::vector<std::string>& words, std::string_view separator);
std::string_view trim(std::string_view text);
bool starts_with(std::string_view text, std::string_view prefix);
bool ends_with(std::string_view text, std::string_view suffix);

}  // namespace rigc
