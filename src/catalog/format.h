// SPDX-License-Identifier: MIT
// The keys of module descriptors and of shapes as tables: their readers and JSON Schemas share
// them. Test: tests/catalog/descriptor_test.cpp, tools/node/check_templates.mjs
#pragma once

#include "base/format.h"

namespace rigc::catalog {

inline constexpr double kFarthest = 1000;  ///< coordinate of a shape
inline constexpr std::size_t kMostPoints = 4096;

const yaml::Section& descriptor_format();
const yaml::Section& frame_format();  ///< an item of `parameters:` that opens a frame
const yaml::Section& parameter_format();
const yaml::Section& creates_format();
const yaml::Section& change_format();
const yaml::Section& shape_format();
const yaml::Section& circle_format();

}  // namespace rigc::catalog
