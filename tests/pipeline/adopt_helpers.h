// SPDX-License-Identifier: MIT
// For tests of adopt: a shot, what another program leaves of its file, and looks at the result.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "gltf/rig.h"
#include "pipeline/adopt.h"
#include "pipeline/character_helpers.h"

namespace rigc::test {

/// A biped's rig with a clip `walk` on its controls (linear translation and rotation of the body,
/// steps of a hand, keys on an attribute), and where its parts are.
struct WalkShot {
  std::string path;
  int body = -1, hand = -1, settings = -1, free = -1;  ///< glTF nodes
  std::string identity(int node) const;
};
WalkShot make_shot(const std::string& name);

/// What Blender leaves of a file: no extensions, no pointers; nodes in another order, under other
/// names; line meshes gone; every clip sampled at 24 frames a second, all three channels of every
/// node that it moves, up to the last whole frame.
class OtherProgram {
 public:
  explicit OtherProgram(const std::string& path);

  nlohmann::ordered_json& json() { return character_.json; }
  /// The node that says the same as one of the shot's.
  nlohmann::ordered_json& node(const WalkShot& shot, int index);
  int index(const nlohmann::ordered_json& node);
  std::vector<float> floats(const nlohmann::ordered_json& accessor) const;
  int add_accessor(const std::string& type, const std::vector<float>& values, std::size_t count);
  /// All skins bound elsewhere, as Blender does where the topmost joint stands in mid-clip.
  void move_bind(const math::Affine& motion);
  void save(const std::string& path) const { save_glb(character_, path); }

 private:
  void resample();
  nlohmann::ordered_json sampled(const nlohmann::ordered_json& clip, int node,
                                 const std::string& path);
  Character character_;
};

std::optional<pipeline::Adopted> adopt(const std::string& edited, const std::string& original,
                                       const std::string& out, Diagnostics& diagnostics,
                                       bool skeleton = false,
                                       const std::vector<std::string>& clips = {});
/// The same without any diagnostic.
pipeline::Adopted adopted(const std::string& edited, const std::string& original,
                          const std::string& out, bool skeleton = false);

anim::Clip clip_of(const std::string& path, const std::string& name);
const anim::Channel* find(const anim::Clip& clip, int node, anim::Path path);
std::vector<double> value_at(const anim::Clip& clip, int node, anim::Path path, double seconds);
/// The only rig of a file.
gltf::Rig rig_of(const std::string& path);
bool near(const std::vector<double>& a, const std::vector<double>& b, double tolerance);

}  // namespace rigc::test
