// SPDX-License-Identifier: MIT
// Rules of expressions and remaps. Test: tests/eval/compile_test.cpp, tests/eval/remap_test.cpp
#include <cmath>

#include <fmt/format.h>
#include "eval/rules_of_kinds.h"

namespace rigc::eval {

namespace {

namespace expression = scene::expression;
namespace remap_at = scene::remap;

struct CurvePoint {
  double position, value, interpolation, tangent;
};

// Slope at the end of a curve from its two nearest segments, kept from overshooting (as in PCHIP).
double end_tangent(double h0, double h1, double slope0, double slope1) {
  const double tangent = ((2 * h0 + h1) * slope0 - h0 * slope1) / (h0 + h1);
  if (tangent * slope0 <= 0) return 0;
  if (slope0 * slope1 <= 0 && std::fabs(tangent) > 3 * std::fabs(slope0)) return 3 * slope0;
  return tangent;
}

// Fritsch and Butland 1984: the weighted harmonic mean of the slopes on both sides, 0 at extremes.
void set_tangents(std::vector<CurvePoint>& points) {
  const std::size_t n = points.size();
  if (n < 2) return;
  std::vector<double> h, slope;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h.push_back(points[i + 1].position - points[i].position);
    slope.push_back((points[i + 1].value - points[i].value) / h.back());
  }
  if (n == 2) {
    points[0].tangent = points[1].tangent = slope[0];
    return;
  }
  points[0].tangent = end_tangent(h[0], h[1], slope[0], slope[1]);
  points[n - 1].tangent = end_tangent(h[n - 2], h[n - 3], slope[n - 2], slope[n - 3]);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (slope[i - 1] * slope[i] <= 0) continue;
    const double w0 = 2 * h[i] + h[i - 1], w1 = h[i] + 2 * h[i - 1];
    points[i].tangent = (w0 + w1) / (w0 / slope[i - 1] + w1 / slope[i]);
  }
}

}  // namespace

Plugs expression_reads(const scene::Scene& scene, scene::NodeId node) {
  Plugs plugs;
  const auto count = static_cast<std::int32_t>(element_count(scene, node, expression::kInputs));
  for (std::int32_t i = 0; i < count; ++i) plugs.push_back({node, expression::kInputs, i});
  return plugs;
}

std::optional<Operand> expression_emit(Emitter& emitter, const scene::Scene& scene,
                                       scene::NodeId node, const Operands& arguments,
                                       Diagnostics& diagnostics) {
  const auto code = std::get<std::string>(scene.value({node, expression::kCode}));
  const auto formula = scene::parse_formula(code, scene[node].origin.span,
                                            static_cast<int>(arguments.size()), diagnostics);
  if (!formula) return std::nullopt;
  Operands inputs(formula->steps.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const scene::Formula::Step& step = formula->steps[i];
    if (step.op == scene::FormulaOp::input)
      inputs[i] = arguments[static_cast<std::size_t>(step.input)];
  }
  return emit_steps(emitter, *formula, formula->result, inputs, node.index);
}

Plugs remap_reads(const scene::Scene&, scene::NodeId node) {
  Plugs plugs;
  for (std::uint16_t i = remap_at::kInput; i <= remap_at::kOutputMax; ++i)
    plugs.push_back({node, i});
  return plugs;
}

std::optional<Operand> remap_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                  const Operands& arguments, Diagnostics& diagnostics) {
  const auto numbers = std::get<std::vector<double>>(scene.value({node, remap_at::kPoints}));
  if (numbers.size() % 3 != 0) {
    return bad_node(scene, node, "its points are not three numbers each", diagnostics);
  }
  std::vector<CurvePoint> points;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    points.push_back({numbers[i], numbers[i + 1], numbers[i + 2], 0});
    const double kind = points.back().interpolation;
    if (kind != 0 && kind != 1 && kind != 2 && kind != 3) {
      return bad_node(scene, node, fmt::format("there is no interpolation {}", kind), diagnostics);
    }
    if (i > 0 && !(numbers[i] > numbers[i - 3])) {
      return bad_node(scene, node, "the positions of its points do not rise", diagnostics);
    }
  }
  set_tangents(points);
  std::vector<double> data{scene.number({node, remap_at::kClamp}),
                           static_cast<double>(points.size())};
  for (const CurvePoint& p : points) {
    data.insert(data.end(), {p.position, p.value, p.interpolation, p.tangent});
  }
  return emitter.emit(Op::remap, arguments, data, 1, node.index);
}

OutputPlace number_place(const scene::Plug&) { return {0, 1}; }

}  // namespace rigc::eval
