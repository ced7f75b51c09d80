// SPDX-License-Identifier: MIT
// Scenes and clips for the tests of src/bake, made by hand; players of what came out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "scene/edit.h"

namespace rigc::bake::test {

/// A scene whose nodes are their own glTF nodes (transforms; others have none).
class Stage {
 public:
  Stage() : edit(scene, journal_, nullptr) {}

  scene::NodeId joint(const std::string& name, scene::NodeId parent, const math::Trs& rest);
  scene::NodeId made(scene::Kind kind, const std::string& name, scene::NodeId parent = {});
  /// A control at the rest of a joint, under a zero, that the joint follows by a parent constraint.
  scene::NodeId control_for(scene::NodeId joint, scene::NodeId parent = {});
  void set_rest(scene::NodeId node, const math::Trs& rest);

  scene::Scene scene;

 private:
  scene::Journal journal_;

 public:
  scene::Edit edit;
  std::vector<int> nodes() const;
};

/// A channel with linear keys.
anim::Channel channel(scene::NodeId node, anim::Path path, std::vector<float> times,
                      std::vector<float> values,
                      anim::Interpolation interpolation = anim::Interpolation::linear);

/// World matrices of all nodes of a stage in a clip, by direct evaluation.
std::vector<math::Affine> evaluated(const Stage& stage, const anim::Clip& clip, double seconds);

/// World matrices as a glTF player shows them: the nodes as they stand, and channels. `standings`
/// as for a bake.
std::vector<math::Affine> played(const Stage& stage, const std::vector<Standing>& standings,
                                 const anim::Clip& clip, double seconds);
/// Every node as the scene has it.
std::vector<Standing> as_scene(const Stage& stage);

double difference(const math::Affine& a, const math::Affine& b);

const anim::Channel* find(const anim::Clip& clip, scene::NodeId node, anim::Path path);

/// Bakes; fails the test on an error.
anim::Clip baked(const Stage& stage, const anim::Clip& clip, const Options& options,
                 Report& report);

}  // namespace rigc::bake::test
