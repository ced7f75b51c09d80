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

Character load_glb(const std::string& path);
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

/// Turns every joint's own axes by a random rotation; the mesh stays skinned as it was. Clips are
/// removed.
Character with_random_axes(Character character, unsigned seed);
/// Puts scale (or a mirror) above the skeleton and takes it out below, so that the figure looks the
/// same. Clips are removed.
Character under_scaled_ancestor(Character character, math::Vec3 scale);
/// Turns the whole character about Y. Clips are removed.
Character turned(Character character, double degrees);

/// Worlds of all nodes of a file at a time of a clip, played as glTF says; without a clip as the
/// nodes stand.
std::vector<math::Affine> play(const std::string& path, const std::string& clip, double seconds);

/// The file's first skin: nodes by joint name.
std::map<std::string, int> joints_by_name(const nlohmann::ordered_json& json);

}  // namespace rigc::test
