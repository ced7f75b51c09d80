// SPDX-License-Identifier: MIT
// Numbers as glTF stores them. Test: tests/gltf/float_text_test.cpp
#include "gltf/float_text.h"

#include <bit>
#include <charconv>

#include "math/math.h"

namespace rigc::gltf {

std::string float_text(double value) {
  const auto number = static_cast<float>(value);
  if (number == 0) return "0";
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, number);
  return std::string(text, end);
}

std::string float_list(const double* first, std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) {
    if (i != 0) text += ',';
    text += float_text(first[i]);
  }
  return text + ']';
}

void append_unsigned(std::string& bytes, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
}

void append_float(std::string& bytes, double value) {
  append_unsigned(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
}

double linear_light(double srgb) {
  if (srgb <= 0.04045) return srgb <= 0 ? 0 : srgb / 12.92;
  return srgb >= 1 ? 1 : math::pow((srgb + 0.055) / 1.055, 2.4);
}

}  // namespace rigc::gltf
