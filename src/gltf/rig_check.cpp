// SPDX-License-Identifier: MIT
// Whether a rig can be written. Test: tests/gltf/rig_test.cpp
#include "gltf/rig_check.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_reader.h"

namespace rigc::gltf {
namespace {

using scene::NodeId;

struct Fits {
  bool operator()(double n) const { return std::abs(n) <= kLargestNumber; }
  bool operator()(const math::Vec3& v) const {
    return (*this)(v.x) && (*this)(v.y) && (*this)(v.z);
  }
  bool operator()(const math::Quat& q) const {
    return (*this)(math::Vec3{q.x, q.y, q.z}) && (*this)(q.w);
  }
  bool operator()(const math::Affine& a) const {
    return (*this)(a.linear.x) && (*this)(a.linear.y) && (*this)(a.linear.z) && (*this)(a.origin);
  }
  bool operator()(const std::string&) const { return true; }
  bool operator()(const std::vector<double>& list) const {
    for (const double n : list)
      if (!(*this)(n)) return false;
    return true;
  }
};

void check_node(const scene::Scene& scene, NodeId id, Diagnostics& diagnostics) {
  const scene::Node& node = scene[id];
  const auto report = [&](std::string_view attribute) {
    diagnostics.report(codes::kNotWritable, node.origin.span,
                       fmt::format("\"{}\" of node \"{}\" is not finite or above 1e30", attribute,
                                   printable(node.name)));
  };
  const auto attributes = scene::spec(node.kind).attributes;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    if (attributes[i].role == scene::Role::output) continue;
    if (node.attributes[i].size() > kMostElements)
      diagnostics.report(
          codes::kRigTooLarge, node.origin.span,
          fmt::format("\"{}\" of node \"{}\" has {} elements; at most {} are allowed",
                      attributes[i].name, printable(node.name), node.attributes[i].size(),
                      kMostElements));
    for (const scene::Value& value : node.attributes[i]) {
      if (std::visit(Fits{}, value)) continue;
      report(attributes[i].name);
      break;
    }
  }
  for (const scene::UserAttribute& attribute : node.user) {
    const Fits fits;
    if (!fits(attribute.value) || !fits(attribute.initial) || !fits(attribute.min.value_or(0)) ||
        !fits(attribute.max.value_or(0)))
      report(attribute.name);
  }
}

void check_count(std::size_t count, std::size_t most, const char* what, Diagnostics& diagnostics) {
  if (count <= most) return;
  diagnostics.report(codes::kRigTooLarge, {},
                     fmt::format("the rig has {} {}; at most {} are allowed", count, what, most));
}

void check_depths(const scene::Scene& scene, Diagnostics& diagnostics) {
  std::vector<NodeId> open;
  std::vector<std::size_t> depths(scene.size(), 1);
  for (const NodeId id : scene.nodes())
    if (!scene[id].parent.valid()) open.push_back(id);
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    if (depths[id.index] > kMostDepth) {
      diagnostics.report(codes::kRigTooLarge, scene[id].origin.span,
                         fmt::format("more than {} nodes are above \"{}\"", kMostDepth,
                                     printable(scene[id].name)));
      return;
    }
    for (const NodeId child : scene[id].children) {
      depths[child.index] = depths[id.index] + 1;
      open.push_back(child);
    }
  }
}

}  // namespace

bool check_writable(const Rig& rig, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  check_count(rig.skeleton.joints.size(), kMostJoints, "joints", diagnostics);
  check_count(rig.scene.size(), kMostNodes, "nodes", diagnostics);
  check_count(rig.commands.size(), kMostNodes, "commands", diagnostics);
  check_depths(rig.scene, diagnostics);
  for (const NodeId id : rig.scene.nodes()) check_node(rig.scene, id, diagnostics);
  return diagnostics.errors() == errors;
}

}  // namespace rigc::gltf
