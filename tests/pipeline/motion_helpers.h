// SPDX-License-Identifier: MIT
// For motion tests: a model's rig, keys said in the world, and where they bring every node.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "gltf/rig.h"
#include "pipeline/character_helpers.h"

namespace rigc::test {

/// The value of one attribute of a control.
struct Key {
  int node = -1;  ///< glTF
  anim::Path path = anim::Path::translation;
  std::string attribute;
  std::vector<float> value, rest;
};
using Pose = std::vector<Key>;

/// A built rig, and where its space lies in the world. All places are of the world.
struct Rigged {
  std::string path, model;
  std::unique_ptr<gltf::Rig> rig;
  math::Affine space;
  math::Mat3 axes;    ///< of the character: left, up, forward
  double height = 0;  ///< of the character

  const scene::Scene& scene() const { return rig->scene; }
  math::Affine world(scene::NodeId id) const { return space * scene().rest_world(id); }
  int gltf_node(scene::NodeId id) const { return rig->nodes[id.index]; }
  scene::NodeId joint(const JointKey& key) const;
  scene::NodeId joint_at(int node) const;  ///< by glTF node
  scene::NodeId joint_of(scene::NodeId control) const {
    return joint(scene()[control].identity.owner);
  }
  /// Whether something moves or turns a joint; others stand as their nodes do.
  bool is_driven(scene::NodeId joint) const;
  /// At least one, in the order made.
  std::vector<scene::NodeId> controls(const std::string& local, const std::string& role) const;
  /// The one control that a module made in a role.
  scene::NodeId control(const std::string& module, const std::string& role) const;

  /// A turn about an axis given as [left, up, forward] of the character.
  math::Quat turn_about(math::Vec3 axis, double radians) const;
  /// Brings a control to a point while what it hangs under rests.
  Key move_to(scene::NodeId control, math::Vec3 point) const;
  Key turn_by(scene::NodeId control, math::Quat turn) const;
  Key switch_to(const std::string& group, float ik) const;
};

/// Builds a template onto a model, into `NAME_rig.glb`. `rest`, `features`: as for `--rest` and
/// `--feature`.
Rigged rig_model(const std::string& model, const std::string& map, const std::string& name,
                 const std::string& template_name = "biped.yaml", const std::string& rest = "bind",
                 const std::vector<std::string>& features = {});

/// Keys one pose a second (what a pose does not say rests), bakes that, and plays it: worlds of all
/// nodes by second. Writes `NAME_keyed.glb` and `NAME_baked.glb`.
std::vector<std::vector<math::Affine>> bake_poses(const Rigged& rigged,
                                                  const std::vector<Pose>& poses,
                                                  const std::string& name);

}  // namespace rigc::test
