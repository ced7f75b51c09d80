// SPDX-License-Identifier: MIT
// Numbers of an accessor: strides, normalised integers, sparse elements. Test:
// tests/gltf/clips_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "gltf/slim.h"

namespace rigc::gltf {

/// The first `count` elements of an accessor as [count][width] floats; integers are normalised
/// where the accessor says so (glTF 2.0, section 3.11). Bytes that are missing or compressed,
/// numbers that are not finite and bad sparse indices are reported.
std::optional<std::vector<float>> read_floats(const File& file, const Slim& slim, int accessor,
                                              std::uint64_t count, Diagnostics& diagnostics);

/// The times of a sampler's input; such as do not rise are reported, too.
std::optional<std::vector<float>> read_times(const File& file, const Slim& slim, int accessor,
                                             Diagnostics& diagnostics);

}  // namespace rigc::gltf
