// SPDX-License-Identifier: MIT
// Shapes of controls by name. Test: tests/modules/edit_shape_test.cpp
#include "modules/shapes.h"

#include "base/text.h"

namespace rigc::modules {

std::optional<ShapeLines> find_shape(const Builder& b, const std::string& name) {
  for (const tags::NamedShape& shape : b.skeleton().shapes) {
    if (shape.name == name) return shape.lines;
  }
  const catalog::Shape* shape = b.catalogue().find_shape(name);
  if (!shape) return std::nullopt;
  ShapeLines lines;
  for (const auto& line : shape->lines) {
    auto& points = lines.emplace_back();
    for (const catalog::Point& p : line) points.push_back({p[0], p[1], p[2]});
  }
  return lines;
}

std::string suggest_shape(const Builder& b, const std::string& name) {
  std::vector<std::string> names;
  for (const tags::NamedShape& shape : b.skeleton().shapes) names.push_back(shape.name);
  for (std::string& built_in : b.catalogue().shapes()) names.push_back(std::move(built_in));
  return suggest(name, names);
}

double shape_decimals(double size) {
  double decimals = 1;
  while (decimals * size < 1e4 && decimals < 1e12) decimals *= 10;
  return decimals;
}

}  // namespace rigc::modules
