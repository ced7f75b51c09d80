// SPDX-License-Identifier: MIT
// Shapes of controls by name: those of the template, then those that come with rigc. Test:
// tests/modules/edit_shape_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/builder.h"

namespace rigc::modules {

/// Polylines of a shape of size 1.
using ShapeLines = std::vector<std::vector<math::Vec3>>;

std::optional<ShapeLines> find_shape(const Builder& b, const std::string& name);
/// What a name that no shape has may have meant.
std::string suggest_shape(const Builder& b, const std::string& name);
/// Ten to the number of decimals that draw a shape of this size to a ten-thousandth of it.
double shape_decimals(double size);

}  // namespace rigc::modules
