// SPDX-License-Identifier: MIT
// The rule of splines: what the curve is at rest goes into the kernel's table, so that controls at
// rest give outputs at rest. Test: tests/eval/spline_test.cpp
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include "eval/kernels/spline_table.h"
#include "eval/rules_of_kinds.h"
#include "eval/values.h"
#include "math/generic/spline.h"
#include "math/spline.h"

namespace rigc::eval {

namespace at = scene::spline;

namespace {

using math::Affine;
using math::Mat3;
using math::Vec3;

constexpr double kUnlimited = 1e6;  // that many times its length no curve gets

/// What a node says about rest.
struct Rest {
  std::vector<Affine> controls, places;
  std::vector<double> follows, parameters;
  bool aims = false;
};

std::vector<Affine> matrices(const scene::Scene& scene, scene::NodeId node, std::uint16_t what) {
  std::vector<Affine> found;
  for (const scene::Value& value : scene[node].attributes[what]) {
    const Affine& matrix = std::get<Affine>(value);
    found.push_back({math::orthonormal(matrix.linear), matrix.origin});
  }
  return found;
}

std::vector<double> numbers(const scene::Scene& scene, scene::NodeId node, std::uint16_t what) {
  std::vector<double> found;
  append(found, scene, node, what);
  return found;
}

/// What is wrong with a node; empty: nothing.
std::string mistake(const Rest& rest, std::size_t controls, std::size_t twists) {
  if (controls < 2 || controls > spline::kMostControls)
    return fmt::format("it has {} controls, not 2 to {}", controls, spline::kMostControls);
  if (rest.controls.size() != controls || rest.follows.size() != controls)
    return fmt::format("{} controls, {} of them at rest and {} that directions follow", controls,
                       rest.controls.size(), rest.follows.size());
  if (twists != 0 && twists != controls)
    return fmt::format("{} controls and {} twists", controls, twists);
  const std::vector<double>& x = rest.parameters;
  if (x.empty() || x.size() > spline::kMostOutputs)
    return fmt::format("it has {} outputs, not 1 to {}", x.size(), spline::kMostOutputs);
  if (rest.places.size() != x.size())
    return fmt::format("{} parameters and {} places", x.size(), rest.places.size());
  if (!std::is_sorted(x.begin(), x.end()) || !(x.front() >= 0) ||
      !(x.back() <= static_cast<double>(controls - 1)))
    return "its parameters do not rise from 0 to the last control";
  return {};
}

void append(std::vector<double>& data, Vec3 v) { data.insert(data.end(), {v.x, v.y, v.z}); }
void append(std::vector<double>& data, const math::generic::BasisOf<double>& b) {
  data.insert(data.end(), {b.from, b.leaving, b.to, b.arriving});
}

/// The curve at rest as each control sees it. The frames there are carried from one to the next
/// without twist, so that none is counted between controls at rest.
void append_controls(std::vector<double>& data, const Rest& rest, const math::Spline& curve) {
  Vec3 x{1, 0, 0}, y{0, 1, 0};
  for (std::size_t i = 0; i < rest.controls.size(); ++i) {
    const Vec3 direction = curve.directions()[i];
    const Vec3 along = math::normalised(direction, x);
    y = i == 0 ? math::perpendicular(along) : math::generic::swung(y, x, along);
    x = along;
    const Mat3 back = math::transposed(rest.controls[i].linear);
    append(data, back * direction);
    data.push_back(rest.follows[i]);
    append(data, back * x);
    append(data, back * y);
  }
}

/// With outputs on the curve, turned as its frames.
std::vector<double> table(const Rest& rest, const math::Spline& curve, bool moves, bool twisted) {
  const std::size_t controls = rest.controls.size(), outputs = rest.places.size();
  std::vector<double> data{static_cast<double>(controls),
                           static_cast<double>(outputs),
                           0.0,
                           moves ? 1.0 : 0.0,
                           twisted ? 1.0 : 0.0,
                           1.0,
                           curve.length()};
  append_controls(data, rest, curve);
  for (std::size_t k = 0; k < outputs; ++k) {
    const double x = rest.parameters[k];
    const double segment = std::min(std::floor(x), static_cast<double>(controls - 2));
    data.insert(data.end(), {segment, x - segment});
    append(data, math::generic::place_basis(x - segment));
    append(data, math::generic::slope_basis(x - segment));
    data.push_back(curve.passed(x));
    const bool last = k + 1 == outputs;
    data.push_back(last ? 0 : math::length(rest.places[k + 1].origin - rest.places[k].origin));
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{}})
      append(data, axis);
  }
  return data;
}

std::uint32_t width_of(const Rest& rest) {
  return spline::kFirstWorld + 12 * static_cast<std::uint32_t>(rest.places.size());
}

double* output_row(std::vector<double>& data, const Rest& rest, std::size_t k) {
  return data.data() + spline::kRows + rest.controls.size() * spline::kControlRow +
         k * spline::kOutputRow;
}

/// Where the kernel brings the outputs of a table with the controls at rest.
std::vector<Affine> outputs_at_rest(Emitter& emitter, const Rest& rest, std::vector<double> data) {
  data[spline::kMoves] = data[spline::kTwisted] = 0;
  Operands arguments{emitter.constant_matrix(Affine{}), emitter.constant({0}),
                     emitter.constant({0}), emitter.constant({1})};
  for (const Affine& control : rest.controls) arguments.push_back(emitter.constant_matrix(control));
  const Operand result = emitter.emit(Op::spline, arguments, data, width_of(rest), 0);
  std::vector<Affine> found;
  for (std::uint32_t k = 0; k < rest.places.size(); ++k)
    found.push_back(emitter.matrix(slice(result, spline::kFirstWorld + 12 * k, 12)));
  return found;
}

/// Writes how the outputs lie at rest as seen from the curve: first their places, on which depends
/// where they aim, then their axes.
void add_offsets(Emitter& emitter, const Rest& rest, std::vector<double>& data) {
  const std::vector<Affine> along = outputs_at_rest(emitter, rest, data);
  for (std::size_t k = 0; k < along.size(); ++k) {
    const Vec3 offset =
        math::transposed(along[k].linear) * (rest.places[k].origin - along[k].origin);
    double* to = output_row(data, rest, k) + spline::kOffset;
    for (const double number : {offset.x, offset.y, offset.z}) *to++ = number;
  }
  data[spline::kAims] = rest.aims ? 1 : 0;
  const std::vector<Affine> aimed = outputs_at_rest(emitter, rest, data);
  for (std::size_t k = 0; k < aimed.size(); ++k) {
    const auto axes = columns_of(math::transposed(aimed[k].linear) * rest.places[k].linear);
    std::copy(axes.begin(), axes.end(), output_row(data, rest, k) + spline::kTurned);
  }
}

}  // namespace

Plugs spline_reads(const scene::Scene& scene, scene::NodeId node) {
  Plugs plugs{{node, at::kBase}, {node, at::kPreserve}, {node, at::kLeast}, {node, at::kMost}};
  for (const std::uint16_t attribute : {at::kControls, at::kTwists}) {
    const auto count = static_cast<std::int32_t>(element_count(scene, node, attribute));
    for (std::int32_t i = 0; i < count; ++i) plugs.push_back({node, attribute, i});
  }
  return plugs;
}

std::optional<Operand> spline_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                   const Operands& arguments, Diagnostics& diagnostics) {
  const std::size_t controls = element_count(scene, node, at::kControls);
  const Rest rest{matrices(scene, node, at::kRests), matrices(scene, node, at::kPlaces),
                  numbers(scene, node, at::kFollows), numbers(scene, node, at::kParameters),
                  scene.number({node, at::kAims}) != 0};
  const std::string wrong = mistake(rest, controls, element_count(scene, node, at::kTwists));
  if (!wrong.empty()) return bad_node(scene, node, wrong, diagnostics);
  const auto is_zero = [&](const Operand& number) {
    return emitter.is_constant(number) && emitter.numbers(number)[0] == 0;
  };
  const auto is_unlimited = [&](const Operand& number) {
    return emitter.is_constant(number) && emitter.numbers(number)[0] >= kUnlimited;
  };
  Operands used = arguments;
  const auto first_twist = used.begin() + static_cast<std::ptrdiff_t>(spline::kControls + controls);
  const bool twisted = !std::all_of(first_twist, used.end(), is_zero);
  if (!twisted) used.erase(first_twist, used.end());
  std::vector<Vec3> points;
  for (const Affine& control : rest.controls) points.push_back(control.origin);
  const math::Spline curve(points);
  const bool stays = is_zero(used[spline::kPreserve]) && is_zero(used[spline::kLeast]) &&
                     is_unlimited(used[spline::kMost]);
  std::vector<double> data = table(rest, curve, !stays, twisted);
  add_offsets(emitter, rest, data);
  return emitter.emit(Op::spline, used, data, width_of(rest), node.index);
}

OutputPlace spline_place(const scene::Plug& output) {
  if (output.attribute == at::kLength) return {0, 1};
  if (output.attribute == at::kStretch) return {1, 1};
  const auto element = static_cast<std::uint32_t>(
      std::clamp(output.element, 0, static_cast<std::int32_t>(spline::kMostOutputs)));
  return {spline::kFirstWorld + 12 * element, 12};
}

}  // namespace rigc::eval
