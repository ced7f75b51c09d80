// SPDX-License-Identifier: MIT
// Tests of src/base/text.h: numbers by one grammar, names, UTF-8, hostile strings, suggestions.
#include "base/text.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <random>

using namespace rigc;

TEST_CASE("base text: numbers that are read") {
  CHECK(parse_number("0.5") == 0.5);
  CHECK(parse_number("+2") == 2);
  CHECK(parse_number("-2e3") == -2000);
  CHECK(parse_number("017") == 17);
  CHECK(parse_number(".5") == 0.5);
  CHECK(parse_number("1e-999") == 0);
  CHECK(parse_number("0." + std::string(500, '0') + "1") == 0);
  CHECK(parse_number("1" + std::string(400, '0') + "e-400") == 1);
  CHECK(std::signbit(*parse_number("-1e-999")));
}

TEST_CASE("base text: numbers that are refused") {
  for (const char* text : {"", "+", "-", "+-1", "inf", "nan", "-inf", "infinity", "0x10", "1_000",
                           "1,5", " 1", "1 ", "1e999", "-1e400", "1e", "one", "1.2.3", "--1"})
    CHECK_MESSAGE(!parse_number(text), text);
  CHECK(!parse_number("1" + std::string(400, '0') + "e-5"));
  CHECK(!parse_number(std::string_view("1\0", 2)));
}

TEST_CASE("base text: integers") {
  CHECK(parse_integer("017") == 17);
  CHECK(parse_integer("+3") == 3);
  CHECK(parse_integer("-9223372036854775808") == INT64_MIN);
  for (const char* text : {"", "1.0", "1e3", "9223372036854775808", "0x1", "+-1", " 1"})
    CHECK_MESSAGE(!parse_integer(text), text);
}

TEST_CASE("base text: numbers are written short and read back the same") {
  CHECK(number_text(-0.0) == "0");
  CHECK(number_text(100000) == "100000");
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(-2.5) == "-2.5");
  CHECK(number_text(1e300) == "1e+300");
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) CHECK(parse_number(number_text(value)) == value);
  }
}

TEST_CASE("base text: names") {
  for (const char* text : {"a", "_", "arm_l", "A-1", "_0"}) CHECK_MESSAGE(is_name(text), text);
  for (const char* text : {"", "1a", "-a", "a.b", "a b", "ä", "a/b", "a:b", "a\n"})
    CHECK_MESSAGE(!is_name(text), text);
  CHECK(is_name(std::string(255, 'a')));
  CHECK(!is_name(std::string(256, 'a')));
}

TEST_CASE("base text: UTF-8") {
  CHECK(is_utf8(""));
  CHECK(is_utf8("plain text of more than eight bytes"));
  CHECK(is_utf8("\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80"));
  CHECK(is_utf8(std::string_view("\0", 1)));
  for (const char* bad :
       {"\x80", "\xc3", "\xc0\x80", "\xc1\xbf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf0\x80\x80\x80",
        "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "1234567\xe2\x82", "12345678\xe2\x82"})
    CHECK(!is_utf8(bad));
}

TEST_CASE("base text: printable escapes what would act on a terminal") {
  CHECK(printable("a\x1b[31m") == "a\\x1b[31m");
  CHECK(printable("tab\tline\n") == "tab\\x09line\\x0a");
  CHECK(printable("\xff\xc3") == "\\xff\\xc3");
  CHECK(printable("\xc2\x85") == "\\x85");
  CHECK(printable("\xe2\x80\xae") == "\\u202e");
  CHECK(printable("\xc3\xa9") == "\xc3\xa9");
  CHECK(printable("abcdef", 3) == "abc...");
  CHECK(printable("abc", 3) == "abc");
  CHECK(printable("ab\xc3\xa9", 3) == "ab...");
}

TEST_CASE("base text: nearest and suggest") {
  const std::vector<std::string> words{"translate", "rotate", "parent", "local", "label"};
  CHECK(nearest("tranlsate", words) == "translate");
  CHECK(nearest("Parent", words) == "parent");
  CHECK(nearest("lable", words) == "label");
  CHECK(!nearest("zebra", words));
  CHECK(!nearest("", words));
  CHECK(!nearest(std::string(1'000'000, 'a'), words));
  CHECK(nearest("ab", {"xb", "ay"}) == "xb");
  CHECK(suggest("rotat", words) == "did you mean \"rotate\"?");
  CHECK(suggest("zebra", {"on", "off"}) == "one of on, off");
  CHECK(suggest("x", {}) == "");
  CHECK(suggest("zzzzzz", std::vector<std::string>(9, "a")) ==
        "one of a, a, a, a, a, a, a, a, ...");
}

TEST_CASE("base text: split, join, trim") {
  CHECK(split("a,,b", ',') == std::vector<std::string_view>{"a", "", "b"});
  CHECK(split("", ',') == std::vector<std::string_view>{""});
  CHECK(join({"a", "b"}, ", ") == "a, b");
  CHECK(join({}, ", ") == "");
  CHECK(trim(" \t a b\r\n") == "a b");
  CHECK(trim(" ") == "");
  CHECK(starts_with("abc", "ab"));
  CHECK(ends_with("abc", "bc"));
}
