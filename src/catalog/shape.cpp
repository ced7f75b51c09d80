// SPDX-License-Identifier: MIT
// Reads shapes: a map from name to lines, curves and circles in, polylines or diagnostics out.
// Test: tests/catalog/shape_test.cpp
#include "catalog/shape.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "catalog/codes.h"
#include "catalog/format.h"
#include "catalog/polyline.h"
#include "catalog/reader.h"

namespace rigc::catalog {
namespace {

class ShapeReader {
 public:
  ShapeReader(const yaml::Node& node, std::string name, Diagnostics& diagnostics)
      : node_(node), diagnostics_(diagnostics) {
    shape_.name = std::move(name);
  }

  Shape read();

 private:
  void read_lines(std::string_view key);
  std::optional<Polyline> read_line(const yaml::Node& node);
  std::optional<Point> read_point(const yaml::Node& node);
  void read_circle(const yaml::Node& node);
  bool read_arc(const yaml::Node& node, Arc& arc);
  void repeat();
  void mirror();
  void report(const Code& code, const Span& span, std::string message) {
    diagnostics_.report(code, span, fmt::format("shape {}: {}", shape_.name, message));
  }

  const yaml::Node& node_;
  Diagnostics& diagnostics_;
  Shape shape_;
};

Shape ShapeReader::read() {
  const std::size_t errors = diagnostics_.errors();
  yaml::check_section(node_, shape_format(), "shape " + shape_.name, diagnostics_);
  if (!node_.is_map()) return {};
  shape_.help = text_of(node_, "help", diagnostics_);
  read_lines("lines");
  read_lines("curves");
  repeat();
  mirror();
  for (const yaml::Node& circle : list_of(node_, "circles", diagnostics_)) read_circle(circle);
  std::size_t points = 0;
  for (const Polyline& line : shape_.lines) points += line.size();
  if (points > kMostPoints) {
    report(codes::kLargeShape, node_.span,
           fmt::format("{} points are more than {}", points, kMostPoints));
  }
  if (shape_.lines.empty() && diagnostics_.errors() == errors) {
    report(codes::kEmptyShape, node_.span, "it has neither lines nor curves nor circles");
  }
  return std::move(shape_);
}

void ShapeReader::read_lines(std::string_view key) {
  for (const yaml::Node& node : list_of(node_, key, diagnostics_)) {
    auto line = read_line(node);
    if (!line) continue;
    shape_.lines.push_back(key == "curves" ? smooth(*line) : std::move(*line));
  }
}

std::optional<Polyline> ShapeReader::read_line(const yaml::Node& node) {
  if (!node.is_sequence() || node.items.size() < 2 || node.items.size() > kMostPoints) {
    report(codes::kEmptyShape, node.span, "a line is a list of at least two points");
    return std::nullopt;
  }
  Polyline line;
  for (const yaml::Node& item : node.items) {
    if (const auto point = read_point(item)) line.push_back(*point);
  }
  if (line.size() != node.items.size()) return std::nullopt;
  return line;
}

/// [x, z] or [x, y, z].
std::optional<Point> ShapeReader::read_point(const yaml::Node& node) {
  const bool flat = node.is_sequence() && node.items.size() == 2;
  if (!flat && !(node.is_sequence() && node.items.size() == 3)) {
    report(codes::kBadPoint, node.span, "a point is [x, z] or [x, y, z]");
    return std::nullopt;
  }
  const auto numbers = yaml::as_numbers(node, node.items.size(), "point", diagnostics_);
  if (!numbers) return std::nullopt;
  for (double number : *numbers) {
    if (number >= -kFarthest && number <= kFarthest) continue;
    report(codes::kBadPoint, node.span, "a coordinate lies outside -1000..1000");
    return std::nullopt;
  }
  if (flat) return Point{(*numbers)[0], 0, (*numbers)[1]};
  return Point{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

void ShapeReader::read_circle(const yaml::Node& node) {
  yaml::check_section(node, circle_format(), diagnostics_);
  Arc arc;
  if (node.is_map() && read_arc(node, arc)) shape_.lines.push_back(polyline(arc));
}

bool ShapeReader::read_arc(const yaml::Node& node, Arc& arc) {
  const std::size_t errors = diagnostics_.errors();
  const auto number = [&](const char* key, double& value) {
    if (const yaml::Node* given = node.find(key)) {
      value = yaml::as_number(*given, key, diagnostics_).value_or(value);
    }
  };
  number("radius", arc.radius);
  number("from", arc.from);
  number("to", arc.to);
  if (const yaml::Node* centre = node.find("centre")) {
    arc.centre = read_point(*centre).value_or(Point{});
  }
  if (const yaml::Node* normal = node.find("normal")) {
    const std::string axis = word_of(*normal, {"x", "y", "z"}, "normal", diagnostics_);
    if (!axis.empty()) arc.axis = axis[0];
  }
  long long segments = arc.segments;
  if (const yaml::Node* given = node.find("segments")) {
    segments = yaml::as_integer(*given, "segments", diagnostics_).value_or(segments);
  }
  if (!(arc.radius > 0 && arc.radius <= kFarthest)) {
    report(codes::kBadCircle, node.span, "the radius of a circle is above 0, at most 1000");
  }
  if (segments < 3 || segments > 128) {
    report(codes::kBadCircle, node.span, "a circle has 3 to 128 segments");
  }
  const double sweep = arc.to - arc.from;
  const bool turns = sweep != 0 && sweep >= -360 && sweep <= 360;
  if (!turns || arc.from < -360 || arc.from > 360) {
    report(codes::kBadCircle, node.span,
           "an arc goes from one angle to another, at most 360 degrees");
  }
  arc.segments = static_cast<int>(segments);
  return diagnostics_.errors() == errors;
}

void ShapeReader::repeat() {
  const yaml::Node* node = node_.find("repeat");
  if (!node) return;
  const auto count = yaml::as_integer(*node, "repeat", diagnostics_);
  if (!count) return;
  if (*count < 2 || *count > 64) {
    report(codes::kBadRepeat, node->span, fmt::format("{} repeats are not in 2..64", *count));
    return;
  }
  std::vector<Polyline> all;
  for (int i = 0; i < static_cast<int>(*count); ++i) {
    for (const Polyline& line : shape_.lines)
      all.push_back(turned(line, i, static_cast<int>(*count)));
  }
  shape_.lines = std::move(all);
}

void ShapeReader::mirror() {
  const yaml::Node* node = node_.find("mirror");
  if (!node) return;
  const std::string axis = word_of(*node, {"x", "y", "z"}, "mirror", diagnostics_);
  if (axis.empty()) return;
  const std::size_t count = shape_.lines.size();
  for (std::size_t i = 0; i < count; ++i) {
    shape_.lines.push_back(mirrored(shape_.lines[i], static_cast<std::size_t>(axis[0] - 'x')));
  }
}

}  // namespace

std::optional<std::vector<Shape>> read_shapes(const yaml::Node& node, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  std::vector<Shape> shapes;
  if (!expect_map(node, "shapes", diagnostics)) return std::nullopt;
  for (const yaml::Node::Entry& entry : node.entries) {
    yaml::Node name;
    name.kind = yaml::NodeKind::scalar;
    name.text = entry.key;
    name.span = entry.key_span;
    if (!yaml::as_name(name, "name of a shape", diagnostics)) continue;
    shapes.push_back(ShapeReader(entry.value, entry.key, diagnostics).read());
  }
  if (diagnostics.errors() != errors) return std::nullopt;
  return shapes;
}

}  // namespace rigc::catalog
