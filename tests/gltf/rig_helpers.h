// SPDX-License-Identifier: MIT
// Rigs for the tests of src/gltf, made by hand: nothing above src/scene is needed.
#pragma once

#include <string>

#include "gltf/file.h"
#include "gltf/rig.h"
#include "scene/edit.h"

namespace rigc::gltf::test {

/// A rig under construction: one journal, commands by number.
class RigMaker {
 public:
  explicit RigMaker(std::uint32_t id = 0);

  /// A tagged joint and its scene node. `parent` -1: a root.
  scene::NodeId joint(const std::string& name, int parent, const math::Trs& rest,
                      int foreign_node = -1);
  /// A node that command `command` made.
  scene::NodeId node(scene::Kind kind, const std::string& role, scene::NodeId parent = {},
                     std::uint32_t command = 0);
  void command(const std::string& id, const std::string& module);

  scene::Edit edit;
  Rig& rig() { return *rig_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  /// The rig, to write or to look at.
  Rig take() { return std::move(*rig_); }

 private:
  RigMaker(std::uint32_t id, std::unique_ptr<Rig> rig, std::unique_ptr<scene::Journal> journal);
  std::unique_ptr<Rig> rig_;
  std::unique_ptr<scene::Journal> journal_;
  Diagnostics diagnostics_;
};

/// Two bones and a helper root; a control on each bone that drives it, a switch, and all that
/// RIGC_rig stores: tags, features, settings, shapes, commands. `foreign`: glTF nodes of the two
/// bones, -1 for none.
Rig sample_rig(Diagnostics& diagnostics, int foreign_base = -1, int foreign_tip = -1);
/// The same with a proxy mesh around the bones.
Rig proxy_rig(Diagnostics& diagnostics);

/// A model's text as a file of its own, where the validator does not look.
File model_file(const std::string& text, const std::string& name);

/// Writes a rig into a file and opens what came out. The file lies in RIGC_TEST_OUT, for the
/// validator to see.
File written(const File& file, Rig& rig, const std::string& name, int ancestor = -1);

/// The one node of the scene with a role; the first, for roles that several have.
scene::NodeId with_role(const Rig& rig, std::string_view role);
/// The joint of the skeleton with a name.
scene::NodeId joint_named(const Rig& rig, std::string_view name);

}  // namespace rigc::gltf::test
