// SPDX-License-Identifier: MIT
// Shared steps, second part: what hangs under what, in the template's order and in the model's.
// Test: tests/modules/steps_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "modules/codes.h"
#include "modules/steps.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
namespace constraint = scene::constraint;
using scene::Kind;

/// Whether what turns a joint has a node among its targets.
bool turns(const scene::Scene& scene, NodeId node, NodeId joint) {
  const auto source = scene.source({joint, transform::kRotation});
  if (!source) return false;
  const Kind kind = scene[source->node].kind;
  if (kind != Kind::parent_constraint && kind != Kind::orient_constraint) return false;
  const auto count =
      static_cast<std::int32_t>(scene[source->node].attributes[constraint::kTargets].size());
  for (std::int32_t i = 0; i < count; ++i) {
    const auto target = scene.source({source->node, constraint::kTargets, i});
    if (target && target->node == node) return true;
  }
  return false;
}

/// What a constraint on a node's plug alone follows; invalid where there is no such thing.
NodeId single_target(const scene::Scene& scene, const Plug& plug) {
  const auto source = scene.source(plug);
  if (!source || scene[source->node].kind != Kind::parent_constraint) return {};
  if (scene[source->node].attributes[constraint::kTargets].size() != 1) return {};
  const auto target = scene.source({source->node, constraint::kTargets, 0});
  return target ? target->node : NodeId{};
}

/// The control that alone drives a joint, if one does.
NodeId single_driver(const scene::Scene& scene, NodeId joint) {
  const NodeId target = single_target(scene, {joint, transform::kRotation});
  return target.valid() && scene[target].kind == Kind::control ? target : NodeId{};
}

/// The joint that moves as a node does: itself, the joint that a control turns, or that of what the
/// node hangs under or follows; invalid where there is none.
NodeId moved_with(const Builder& b, NodeId node) {
  const scene::Scene& scene = b.scene();
  NodeId at = node;
  // Constraints of the user may go round in a circle, which is found when the rig is compiled.
  for (std::size_t steps = 0; at.valid() && steps < scene.size(); ++steps) {
    if (scene[at].kind == Kind::joint) return at;
    const NodeId own = b.index().joint(scene[at].identity.owner);
    if (own.valid() && turns(scene, at, own)) return own;
    const NodeId target = single_target(scene, {at, transform::kTranslate});
    at = target.valid() ? target : scene[at].parent;
  }
  return {};
}

}  // namespace

bool check_place(Builder& b, NodeId node, std::string_view parameter) {
  if (scene::spec(b.scene()[node].kind).is_transform) return true;
  b.fail(codes::kNotATransform, parameter,
         fmt::format("{} has no place in space", traversal::describe(b.scene(), node)),
         "name a joint, control or transform");
  return false;
}

NodeId space_from(Builder& b, std::string_view parameter, NodeId otherwise) {
  if (!b.with().has(parameter)) return otherwise;
  const NodeId space = b.with().node(parameter);
  return check_place(b, space, parameter) ? space : NodeId{};
}

bool is_driven(const scene::Scene& scene, NodeId node) {
  for (const scene::Connection& connection : scene[node].inputs) {
    if (connection.to.attribute <= transform::kRotate) return true;
  }
  return false;
}

NodeId root_control(const Builder& b) {
  NodeId found;
  for (NodeId id : b.index().made_by(b.global(), "root")) {
    if (b.scene()[id].identity.role == "offset") found = id;
  }
  return found;
}

NodeId joint_above(const Builder& b, NodeId joint) {
  const tags::TaggedJoint* tagged = b.tagged(joint);
  if (tagged && tagged->template_parent.uid != 0) {
    const NodeId found = b.index().joint(tagged->template_parent);
    if (found.valid()) return found;
  }
  return b.scene()[joint].parent;
}

NodeId space_of(const Builder& b, NodeId joint) {
  NodeId at = joint_above(b, joint);
  // Where template and model disagree more than once the way up may be a circle.
  for (std::size_t steps = 0; at.valid() && steps < b.skeleton().joints.size(); ++steps) {
    if (b.scene()[at].kind == Kind::joint && is_driven(b.scene(), at)) {
      const NodeId control = single_driver(b.scene(), at);
      return control.valid() ? control : at;
    }
    at = joint_above(b, at);
  }
  return root_control(b);
}

bool carried_by(const Builder& b, NodeId joint, NodeId space) {
  const NodeId parent = b.scene()[joint].parent;
  if (!space.valid()) return parent.valid();
  const NodeId moved = moved_with(b, space);
  for (NodeId at = parent; at.valid(); at = b.scene()[at].parent) {
    if (moved.valid() ? at == moved : is_driven(b.scene(), at)) return true;
  }
  return false;
}

std::vector<NodeId> chain_between(Builder& b, NodeId first, NodeId last,
                                  std::string_view parameter) {
  std::vector<NodeId> chain;
  for (NodeId at = last; at.valid(); at = b.scene()[at].parent) {
    chain.push_back(at);
    if (at == first) {
      std::reverse(chain.begin(), chain.end());
      return chain;
    }
  }
  b.fail(codes::kNotAChain, parameter,
         fmt::format("{} does not hang below {}", traversal::describe(b.scene(), last),
                     traversal::describe(b.scene(), first)),
         "name the joint nearer to the root as the first");
  return {};
}

bool check_order(Builder& b, const std::vector<NodeId>& joints, std::string_view parameter) {
  std::set<NodeId> above;  // every joint so far, and all above it
  for (NodeId joint : joints) {
    if (above.contains(joint)) {
      b.fail(codes::kNotAChain, parameter,
             fmt::format("{} is or lies above a joint that comes before it",
                         traversal::describe(b.scene(), joint)),
             "name the joints from first to last");
      return false;
    }
    for (NodeId at = joint; at.valid() && above.insert(at).second; at = b.scene()[at].parent) {
    }
  }
  return true;
}

}  // namespace rigc::modules
