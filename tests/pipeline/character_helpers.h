// SPDX-License-Identifier: MIT
// For motion tests: characters as plain JSON and bytes, changed copies of them, and a small player
// of glTF clips that shares no code with rigc's evaluator.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "math/math.h"

namespace rigc::test {

struct Character {
  nlohmann::ordered_json json;
  std::string bin;
};

/// A .glb or .vrm, or a .gltf with all of its buffers joined.
Character load_character(const std::string& path);
inline Character load_glb(const std::string& path) { return load_character(path); }
void save_glb(const Character& character, const std::string& path);

/// A file below the tests' output folder, the folder of the templates that come with rigc, a file's
/// bytes.
std::string test_out(const std::string& name);
std::string templates_folder();
std::string bytes_of(const std::string& path);

/// Path of a corpus file; empty (with a message) where the corpus is absent.
std::string corpus_file(const std::string& name);

/// Notes beside a written file which model it was made from, for the validator run of .ci/run: a
/// path, or the name of a file beside it.
void made_from(const std::string& path, const std::string& model);

math::Affine local_of(const nlohmann::ordered_json& node);
void set_local(nlohmann::ordered_json& node, const math::Affine& local);
std::vector<int> parents_of(const nlohmann::ordered_json& json);

/// What is changed in a copy of a character.
struct Change {
  std::string name;
  unsigned axes_seed = 0;              ///< turns every joint's own axes at random; 0: not
  math::Vec3 ancestor_scale{1, 1, 1};  ///< above the skeleton, and taken out below
  double turn_degrees = 0;             ///< of all about Y
};

/// A copy of a character's skeletons, without meshes and clips, standing in its bind pose. `binds`:
/// world matrices of its joints, by node. Every joint stays where it is, but for the turn.
Character changed(Character character, const std::map<int, math::Affine>& binds,
                  const Change& change);

/// Worlds of all nodes of a file at times of a clip, played as glTF says.
std::vector<std::vector<math::Affine>> play(const std::string& path, const std::string& clip,
                                            const std::vector<double>& seconds);
inline std::vector<math::Affine> play(const std::string& path, const std::string& clip,
                                      double seconds) {
  return play(path, clip, std::vector<double>{seconds}).front();
}

}  // namespace rigc::test
