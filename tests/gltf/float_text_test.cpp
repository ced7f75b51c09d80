// SPDX-License-Identifier: MIT
// Numbers as glTF stores them.
#include "gltf/float_text.h"

#include <doctest/doctest.h>

#include <charconv>
#include <cstring>

#include "tests/math/random.h"

using namespace rigc::gltf;

TEST_CASE("gltf float_text: the shortest text of the nearest float") {
  CHECK(float_text(0.1) == "0.1");
  CHECK(float_text(1.0 / 3) == "0.33333334");
  CHECK(float_text(-0.0) == "0");
  CHECK(float_text(1e-60) == "0");
  CHECK(float_text(2) == "2");
  CHECK(float_text(1e20) == "1e+20");
  const double v[] = {1, -0.5, 0};
  CHECK(float_list(v, 3) == "[1,-0.5,0]");
  CHECK(float_list(v, 0) == "[]");
}

TEST_CASE("gltf float_text: any float comes back from its text and its bytes") {
  rigc::test::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double value = random.between(-1, 1) * (i % 2 == 0 ? 1e6 : 1e-6);
    const std::string text = float_text(value);
    float back = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), back);
    CHECK(end == text.data() + text.size());
    CHECK(static_cast<double>(back) == as_float(value));
    std::string bytes;
    append_float(bytes, value);
    REQUIRE(bytes.size() == 4);
    float stored = 0;
    std::memcpy(&stored, bytes.data(), 4);
    CHECK(stored == back);
  }
}

TEST_CASE("gltf float_text: unsigned numbers are little-endian") {
  std::string bytes;
  append_unsigned(bytes, 0x01020304, 4);
  append_unsigned(bytes, 0x0506, 2);
  append_unsigned(bytes, 7, 1);
  CHECK(bytes == "\x04\x03\x02\x01\x06\x05\x07");
}

TEST_CASE("gltf float_text: sRGB becomes linear light") {
  CHECK(linear_light(0) == 0);
  CHECK(linear_light(1) == 1);
  CHECK(linear_light(0.5) == doctest::Approx(0.21404114));
  CHECK(linear_light(0.02) == doctest::Approx(0.00154799));
  CHECK(linear_light(-3) == 0);
  CHECK(linear_light(3) == 1);
}
