// SPDX-License-Identifier: MIT
// The builder: gives nodes their identity and names, and passes every change to the command's
// journal. Test: tests/modules/builder_test.cpp
#include "modules/builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "modules/codes.h"
#include "scene/formula.h"

namespace rigc::modules {

Builder::Builder(const Job& job, Parameters parameters, scene::Edit& edit)
    : job_(job),
      parameters_(std::move(parameters)),
      edit_(edit),
      joint_(job.index.joint(job.skeleton.joints[job.joint].key)) {}

JointKey Builder::twin() const {
  const tags::TaggedJoint& holder = job_.skeleton.joints[job_.joint];
  const int found = job_.skeleton.find(holder.mirror.opposite);
  if (found < 0) return {};
  const auto& commands = job_.skeleton.joints[static_cast<std::size_t>(found)].commands;
  const bool twin = std::any_of(commands.begin(), commands.end(), [&](const auto& command) {
    return command.module == job_.command.module && command.id == job_.command.id;
  });
  return twin ? holder.mirror.opposite : JointKey{};
}

const tags::TaggedJoint* Builder::tagged(NodeId joint) const {
  const scene::Node& node = scene()[joint];
  if (!node.is_skeleton()) return nullptr;
  const int found = job_.skeleton.find(node.identity.owner);
  return found < 0 ? nullptr : &job_.skeleton.joints[static_cast<std::size_t>(found)];
}

std::vector<tags::BoundVertex> Builder::vertices(const std::vector<NodeId>& joints) const {
  std::vector<int> nodes;
  math::Affine bound;
  for (NodeId joint : joints) {
    const tags::TaggedJoint* of_model = joint.valid() ? tagged(joint) : nullptr;
    if (!of_model || of_model->foreign_node < 0) continue;
    if (nodes.empty()) bound = scene().rest_world(joint);
    nodes.push_back(of_model->foreign_node);
  }
  if (!job_.geometry.vertices || nodes.empty()) return {};
  std::vector<tags::BoundVertex> found = job_.geometry.vertices(nodes);
  for (tags::BoundVertex& vertex : found) vertex.at = bound * vertex.at;
  return found;
}

namespace {

/// Brings a surface into a space. Mirrored triangles are seen from their other side.
void place(tags::Surface& surface, const math::Affine& into) {
  for (math::Vec3& at : surface.places) at = into * at;
  if (math::determinant(into.linear) < 0)
    for (auto& corners : surface.triangles) std::swap(corners[1], corners[2]);
}

}  // namespace

std::optional<tags::Surface> Builder::surface(const std::string& name) const {
  if (!job_.geometry.surfaces) return std::nullopt;
  std::map<int, const tags::TaggedJoint*> joints;
  for (const tags::TaggedJoint& joint : skeleton().joints)
    if (joint.foreign_node >= 0) joints.emplace(joint.foreign_node, &joint);
  const int own = skeleton().joints[job_.joint].foreign_node;
  std::vector<tags::Surface> moved, others;
  for (tags::Surface& surface : job_.geometry.surfaces(name)) {
    const auto& bound = surface.bound;
    auto by = std::find_if(bound.begin(), bound.end(),
                           [&](const auto& each) { return each.first == own; });
    if (by == bound.end())
      by = std::find_if(bound.begin(), bound.end(),
                        [&](const auto& each) { return joints.count(each.first) != 0; });
    if (by != bound.end()) {
      const NodeId joint = index().joint(joints.at(by->first)->key);
      place(surface, scene().rest_world(joint) * by->second);
    }
    (by != bound.end() ? moved : others).push_back(std::move(surface));
  }
  if (moved.empty() && others.empty()) return std::nullopt;
  if (moved.size() == 1) return std::move(moved.front());
  tags::Surface none;
  none.trouble = moved.empty() ? "no joint of this rig moves it"
                               : fmt::format("{} nodes with a mesh have this name", moved.size());
  return none;
}

Identifiers Builder::identifiers(NodeId joint) const {
  Identifiers ids = scene()[joint].ids;
  if (const Literal* local = job_.command.find("local")) ids.local = local->text;
  if (const Literal* label = job_.command.find("label")) ids.label = label->text;
  return ids;
}

NodeId Builder::make(const NewNode& request) {
  const NodeId joint = request.joint.valid() ? request.joint : joint_;
  const JointKey owner = scene()[joint].identity.owner;
  scene::Node node;
  node.kind = request.kind;
  node.parent = request.parent;
  node.ids = identifiers(joint);
  node.identity.rig = scene()[joint].identity.rig;
  node.identity.owner = owner;
  node.identity.holder = scene()[joint_].identity.owner;
  node.identity.command = job_.command.id;
  node.identity.role = request.role;
  node.identity.counter = counters_[{owner, request.role}]++;
  const Literal* name = job_.command.find("name");
  const std::string base = name ? name->text : scene()[joint].name;
  node.name = base + "_" + (request.suffix.empty() ? request.role : request.suffix);
  if (name && joint == joint_ && node.identity.counter == 0 && request.suffix.empty() &&
      (request.role == "control" || request.role == "joint" || request.role == "transform")) {
    node.name = base;
  } else if (request.kind == scene::Kind::control && node.identity.counter > 0) {
    node.name += "_" + std::to_string(node.identity.counter + 1);
  }
  node.command = job_.command_index;
  node.module = job_.command.module;
  node.origin = {job_.command.span, scene()[joint_].name, job_.command.id};
  return edit_.make(std::move(node));
}

namespace {

/// Whether values at two plugs of a node override each other: one is the other or a component of
/// it. The Euler view of a rotation counts as the rotation.
bool overlap(const scene::Scene& scene, const Plug& a, const Plug& b) {
  namespace transform = scene::transform;
  const bool is_transform = scene::spec(scene[a.node].kind).is_transform;
  const auto is_rotation = [&](const Plug& p) {
    return p.attribute == transform::kRotation || p.attribute == transform::kRotate;
  };
  if (is_transform && is_rotation(a) && is_rotation(b) && a.attribute != b.attribute) return true;
  if (a.attribute != b.attribute || a.element != b.element) return false;
  return a.component == b.component || a.component < 0 || b.component < 0;
}

}  // namespace

bool Builder::check_free(const Plug& plug, std::string_view parameter) {
  for (const scene::Connection& connection : scene()[plug.node].inputs) {
    if (!overlap(scene(), connection.to, plug)) continue;
    fail(codes::kAlreadyDriven, parameter,
         fmt::format("{} of {} is driven already, by {}", scene().plug_name(connection.to),
                     traversal::describe(scene(), plug.node),
                     traversal::describe(scene(), connection.from.node)),
         "switch one of the two commands off, or give one constraint both targets");
    return false;
  }
  return true;
}

void Builder::connect(const Plug& from, const Plug& to) {
  if (check_free(to, {})) edit_.connect(from, to);
}

bool Builder::check_formula(std::string_view parameter, const BoundExpression& bound) {
  const auto formula = scene::parse_formula(bound.code, parameters_.span(parameter),
                                            static_cast<int>(bound.plugs.size()), job_.diagnostics);
  failed_ = failed_ || !formula;
  return formula.has_value();
}

void Builder::fail(const Code& code, std::string_view parameter, std::string message,
                   std::string hint) {
  failed_ = true;
  warn(code, parameter, std::move(message), std::move(hint));
}

void Builder::warn(const Code& code, std::string_view parameter, std::string message,
                   std::string hint) {
  const Span span = parameter.empty() ? job_.command.span : parameters_.span(parameter);
  job_.diagnostics.report(code, span, std::move(message), std::move(hint));
}

}  // namespace rigc::modules
