// SPDX-License-Identifier: MIT
// A control shape as data: polylines in a unit frame. Test: tests/catalog/shape_test.cpp
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/yaml.h"

namespace rigc::catalog {

using Point = std::array<double, 3>;

/// Polylines around the origin; flat shapes lie in the XZ plane, front is +Z, about one unit
/// across.
struct Shape {
  std::string name;
  std::string help;
  std::vector<std::vector<Point>>
      lines;  ///< each at least two points; closed ones repeat their first
  bool operator==(const Shape&) const = default;
};

/// `shapes:` of a template or a file of shapes/: a map from name to {help, lines, curves, circles,
/// repeat, mirror} (docs/adding_a_module.md).
std::optional<std::vector<Shape>> read_shapes(const yaml::Node& node, Diagnostics& diagnostics);

}  // namespace rigc::catalog
