// SPDX-License-Identifier: MIT
// What the weighted constraints share.
// Test: tests/modules/constraints_test.cpp
#include "modules/constraints/weights.h"

#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/wiring.h"

namespace rigc::modules {

std::vector<Target> constraint_targets(Builder& b) {
  std::vector<Target> targets;
  for (NodeId node : b.with().nodes("targets")) {
    if (check_place(b, node, "targets")) targets.push_back(target(b, node));
  }
  return targets;
}

std::vector<double> constraint_weights(Builder& b, std::size_t targets) {
  if (!b.with().has("weights")) return std::vector<double>(targets, 1.0);
  std::vector<double> weights = b.with().numbers("weights");
  bool negative = false;
  for (double weight : weights) negative = negative || weight < 0;
  if (weights.size() != targets || negative) {
    b.fail(codes::kWeightCount, "weights",
           fmt::format("{} weights for {} targets{}", weights.size(), targets,
                       negative ? ", one of them negative" : ""));
  }
  return weights;
}

std::vector<Plug> weight_attributes(Builder& b, const std::vector<double>& weights) {
  std::vector<Plug> plugs;
  if (!b.with().has("weights_on")) return plugs;
  const NodeId holder = b.with().node("weights_on");
  const std::string& base = b.with().text("weights_name");
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::string name = fmt::format("{}_{}", base, i);
    if (b.scene().find_plug(holder, name)) {
      b.fail(codes::kAttributeExists, "weights_name",
             fmt::format("{} has an attribute \"{}\" already",
                         traversal::describe(b.scene(), holder), name));
      return plugs;
    }
    plugs.push_back(add_number(b, holder, {.name = name, .value = weights[i], .min = 0}));
  }
  return plugs;
}

void connect_weights(Builder& b, NodeId constraint, std::uint16_t attribute,
                     const std::vector<double>& weights) {
  const std::vector<Plug> plugs = weight_attributes(b, weights);
  for (std::size_t i = 0; i < plugs.size() && !b.failed(); ++i)
    b.connect(plugs[i], {constraint, attribute, static_cast<std::int32_t>(i)});
}

NodeId driven_node(Builder& b) {
  const NodeId driven = b.with().node("driven");
  check_place(b, driven, "driven");
  return driven;
}

void connect_axes(Builder& b, const Plug& from, const Plug& to, const std::string& axes) {
  if (axes == "xyz") {
    b.connect(from, to);
    return;
  }
  for (std::int8_t axis = 0; axis < 3; ++axis) {
    if (axes.find(static_cast<char>('x' + axis)) == std::string::npos) continue;
    Plug one_from = from, one_to = to;
    one_from.component = one_to.component = axis;
    b.connect(one_from, one_to);
  }
}

void weighted_constraint(Builder& b, scene::Kind kind) {
  namespace constraint = scene::constraint;
  const NodeId driven = driven_node(b);
  const std::vector<Target> targets = constraint_targets(b);
  const std::vector<double> weights = constraint_weights(b, targets.size());
  if (b.failed()) return;
  const NodeId node =
      make_constraint(b, kind, driven, targets, weights, b.with().flag("maintain"), "constraint");
  connect_weights(b, node, constraint::kWeights, weights);
  const std::string& axes = b.with().text("axes");
  switch (kind) {
    case scene::Kind::point_constraint:
      return connect_axes(b, {node, constraint::kTranslate}, {driven, scene::transform::kTranslate},
                          axes);
    case scene::Kind::scale_constraint:
      return connect_axes(b, {node, constraint::kScale}, {driven, scene::transform::kScale}, axes);
    default:
      break;
  }
  if (axes == "xyz")
    return b.connect({node, constraint::kRotation}, {driven, scene::transform::kRotation});
  connect_axes(b, {node, constraint::kRotate}, {driven, scene::transform::kRotate}, axes);
}

}  // namespace rigc::modules
