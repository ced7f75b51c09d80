// SPDX-License-Identifier: MIT
// Finds the attributes that blend FK and IK: those that the weights of a constraint come from which
// turns a joint with a solver or with something else. Test: tests/bake/transfer_test.cpp
#include <algorithm>
#include <set>

#include "bake/transfer.h"
#include "bake/transfer_plugs.h"
#include "eval/evaluate.h"

namespace rigc::bake {
namespace {

using scene::Kind;
using scene::NodeId;
using scene::Plug;
namespace constraint = scene::constraint;

bool is_solver(const scene::Scene& scene, NodeId id) {
  return scene[id].kind == Kind::ik_two_bone || scene[id].kind == Kind::ik_chain;
}

/// A constraint that turns a joint, and which of its targets a solver computes.
struct Blend {
  std::vector<Plug> weights;
  std::vector<bool> solved;
};

Blend blend_of(const scene::Scene& scene, NodeId joint) {
  Blend blend;
  const auto source = scene.source({joint, scene::transform::kRotation});
  if (!source || scene[source->node].kind != Kind::orient_constraint) return blend;
  const NodeId node = source->node;
  const std::size_t count = scene[node].attributes[constraint::kTargets].size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto element = static_cast<std::int32_t>(i);
    const auto target = scene.source({node, constraint::kTargets, element});
    blend.weights.push_back({node, constraint::kWeights, element});
    blend.solved.push_back(target && is_solver(scene, target->node));
  }
  return blend;
}

/// 1: the solver alone turns the joint; 0: it has no part in it; between: neither.
std::optional<double> share_of_solver(const scene::Scene& scene, const Blend& blend,
                                      const Plug& attribute, double value,
                                      Diagnostics& diagnostics) {
  const auto weights = eval::evaluate(scene, blend.weights, {{attribute, value}}, diagnostics);
  if (!weights) return std::nullopt;
  double sum = 0, solved = 0;
  for (std::size_t i = 0; i < weights->size(); ++i) {
    const double weight = std::max(std::get<double>((*weights)[i]), 0.0);
    sum += weight;
    if (blend.solved[i]) solved += weight;
  }
  return sum > 0 ? solved / sum : 0.5;
}

/// Empty where the attribute's bounds are not FK and IK.
std::optional<Switch> make_switch(const scene::Scene& scene, const Blend& blend,
                                  const Plug& attribute, Diagnostics& diagnostics) {
  const scene::UserAttribute& user =
      scene[attribute.node].user[attribute.attribute - scene::kUserAttributes];
  if (!user.min || !user.max) return std::nullopt;
  const auto at_min = share_of_solver(scene, blend, attribute, *user.min, diagnostics);
  const auto at_max = share_of_solver(scene, blend, attribute, *user.max, diagnostics);
  if (!at_min || !at_max) return std::nullopt;
  const std::string& group = scene[attribute.node].ids.local;
  if (*at_min == 0 && *at_max == 1) return Switch{attribute, *user.min, *user.max, group};
  if (*at_min == 1 && *at_max == 0) return Switch{attribute, *user.max, *user.min, group};
  return std::nullopt;
}

}  // namespace

std::vector<Switch> find_switches(const scene::Scene& scene, Diagnostics& diagnostics) {
  std::vector<Switch> found;
  std::set<Plug> seen;
  for (const NodeId id : scene.nodes()) {
    if (scene[id].kind != Kind::joint) continue;
    const Blend blend = blend_of(scene, id);
    if (std::find(blend.solved.begin(), blend.solved.end(), true) == blend.solved.end()) continue;
    for (const Plug& attribute : attributes_behind(scene, blend.weights)) {
      if (!seen.insert(attribute).second) continue;
      const auto made = make_switch(scene, blend, attribute, diagnostics);
      if (made) found.push_back(*made);
    }
  }
  return found;
}

}  // namespace rigc::bake
