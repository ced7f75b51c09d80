// SPDX-License-Identifier: MIT
// Numbers as glTF stores them: 32-bit floats, as text and as bytes. Test:
// tests/gltf/float_text_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rigc::gltf {

/// The shortest text that reads back as the same 32-bit float; `-0` is written `0`.
std::string float_text(double value);
/// `[x,y,z]`
std::string float_list(const double* first, std::size_t count);

/// The nearest 32-bit float, as the double that it is.
inline double as_float(double value) { return static_cast<double>(static_cast<float>(value)); }

void append_float(std::string& bytes, double value);
/// The low `size` bytes of a number, little-endian.
void append_unsigned(std::string& bytes, std::uint32_t value, std::size_t size);

/// sRGB 0..1 to linear light. Source: IEC 61966-2-1.
double linear_light(double srgb);

}  // namespace rigc::gltf
