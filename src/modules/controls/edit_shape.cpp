// SPDX-License-Identifier: MIT
// edit_shape: another look for a control that an earlier command made. Test:
// tests/modules/edit_shape_test.cpp
#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/shapes.h"
#include "modules/steps.h"

namespace rigc::modules {
namespace {

namespace control = scene::control;
using math::Mat3;
using math::Vec3;

/// How a shape of size 1 lies in its control: p = origin + turn * (u * size).
struct Laid {
  double size = 1;
  math::Quat turn;
  Vec3 origin;
};

ShapeLines unpack(const std::vector<double>& numbers) {
  ShapeLines lines;
  for (std::size_t at = 0; at < numbers.size();) {
    auto& line = lines.emplace_back(static_cast<std::size_t>(numbers[at++]));
    for (Vec3& point : line) {
      point = {numbers[at], numbers[at + 1], numbers[at + 2]};
      at += 3;
    }
  }
  return lines;
}

std::vector<Vec3> all_points(const ShapeLines& lines) {
  std::vector<Vec3> points;
  for (const auto& line : lines) points.insert(points.end(), line.begin(), line.end());
  return points;
}

Vec3 middle(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3& point : points) sum = sum + point;
  return sum * (1 / static_cast<double>(points.size()));
}

/// Mean square distance from `from`.
double spread(const std::vector<Vec3>& points, Vec3 from) {
  double sum = 0;
  for (const Vec3& point : points) sum += dot(point - from, point - from);
  return sum / static_cast<double>(points.size());
}

/// How the shape lies that a control has; about the control itself where it is no known shape.
Laid find_laid(const std::vector<Vec3>& unit, const std::vector<Vec3>& points) {
  Laid laid;
  const bool known = unit.size() == points.size();
  const Vec3 from = known ? middle(unit) : Vec3{}, to = known ? middle(points) : Vec3{};
  const double was = spread(unit, from), is = spread(points, to);
  if (was > 0 && is > 0) laid.size = std::sqrt(is / was);
  if (!known) return laid;
  Mat3 correlation{{}, {}, {}};
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const Vec3 u = unit[i] - from, p = points[i] - to;
    correlation = {correlation.x + p * u.x, correlation.y + p * u.y, correlation.z + p * u.z};
  }
  if (const auto turn = math::fit_rotation(correlation)) laid.turn = *turn;
  laid.origin = to - math::rotate(laid.turn, from * laid.size);
  return laid;
}

/// From the axes of the control on the other side to those of a mirrored one, by reflection: in
/// the other's axes both look the same. No change for a control that mirrors none.
Mat3 from_unmirrored(const Builder& b, NodeId node) {
  const scene::Node& own = b.scene()[node];
  const NodeId joint = b.index().joint(own.identity.owner);
  const auto other = parse_identity(std::get<std::string>(own.attributes[control::kOpposite][0]));
  if (!other || !joint.valid() || !is_mirrored(b, joint)) return {};
  for (const NodeId id : b.index().made_for(other->owner)) {
    if (b.scene()[id].identity != *other) continue;
    const Mat3 axes = math::orthonormal(rest(b, id).linear);
    const Vec3 left = b.character().left;
    const auto reflected = [&](Vec3 v) { return v - left * (2 * dot(left, v)); };
    const Mat3 image{reflected(axes.x), reflected(axes.y), reflected(axes.z)};
    return transposed(math::orthonormal(rest(b, node).linear)) * image;
  }
  return {};
}

std::vector<double> pack(const ShapeLines& lines, double size) {
  const double decimals = shape_decimals(size);
  std::vector<double> out;
  for (const auto& line : lines) {
    out.push_back(static_cast<double>(line.size()));
    for (const Vec3& p : line)
      for (const double x : {p.x, p.y, p.z}) out.push_back(std::nearbyint(x * decimals) / decimals);
  }
  return out;
}

}  // namespace

void edit_shape(Builder& b) {
  const Parameters& with = b.with();
  const NodeId node = with.node("control");
  if (with.has("color")) b.set({node, control::kColor}, with.vec3("color"));
  const auto& attributes = b.scene()[node].attributes;
  const std::string present = std::get<std::string>(attributes[control::kShape][0]);
  ShapeLines lines = unpack(std::get<std::vector<double>>(attributes[control::kPoints][0]));
  if (lines.empty()) return;
  const Mat3 to_own = from_unmirrored(b, node);
  for (auto& line : lines)
    for (Vec3& point : line) point = transposed(to_own) * point;

  const auto unit = find_shape(b, present);
  const std::vector<Vec3> points = all_points(lines);
  Laid laid = find_laid(unit ? all_points(*unit) : std::vector<Vec3>{{1, 0, 0}}, points);
  if (with.has("shape") && with.text("shape") != present) {
    const auto other = find_shape(b, with.text("shape"));
    if (!other) {
      b.fail(codes::kUnknownShape, "shape",
             fmt::format("there is no shape \"{}\"", printable(with.text("shape"))),
             suggest_shape(b, with.text("shape")));
      return;
    }
    lines = *other;
    for (auto& line : lines)
      for (Vec3& point : line) point = laid.origin + math::rotate(laid.turn, point * laid.size);
    b.set({node, control::kShape}, with.text("shape"));
  }
  const math::Quat turn = math::from_euler_degrees(with.vec3("rotate"));
  const double size = with.number("size");
  for (auto& line : lines)
    for (Vec3& point : line)
      point = to_own * (laid.origin + with.vec3("offset") +
                        math::rotate(turn, (point - laid.origin) * size));
  b.set({node, control::kPoints}, pack(lines, laid.size * (size > 0 ? size : 1)));
}

}  // namespace rigc::modules
