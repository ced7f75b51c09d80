// SPDX-License-Identifier: MIT
// Shots for tests of updates: a rig with random animation, how it plays, what it keys. Nothing here
// knows how an update works.
#pragma once

#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "gltf/rig.h"
#include "pipeline/rebuild.h"
#include "pipeline/update.h"

namespace rigc::test {

/// A folder of its own below the tests' output, empty.
std::string fresh_folder(const std::string& name);
void write_text(const std::string& path, const std::string& text);

/// Builds a template into a file.
void build_rig(const std::string& template_file, const std::string& out,
               const std::string& model = "", const std::string& global = "");

/// What a file has, for comparisons.
struct Shot {
  std::optional<gltf::File> file;
  std::vector<gltf::Rig> rigs;
  std::vector<anim::Clip> clips;
  const gltf::Rig& rig(const std::string& global) const;
};
Shot read_shot(const std::string& path);

struct Animation {
  int clips = 2;
  double share = 0.6;        ///< of the controls' properties that a clip keys
  double value_share = 0.3;  ///< that are set without a key
  std::size_t keys = 6;
  double scale_share = 0.3;  ///< of the scales among them
};
/// Keys controls of all rigs at random, with all interpolations, shared and unshared times, several
/// clips, values without keys; in place.
void animate(const std::string& path, unsigned seed, const Animation& animation = {});

/// World matrices of the joints of a rig by uid, at a time of a clip (-1: without a clip).
std::map<JointKey, math::Affine> pose_at(const Shot& shot, const gltf::Rig& rig, int clip,
                                         double seconds);
/// Largest distance (in heights of the character) of joints that both have, over times of all clips
/// and without one. `exact`: whether it is the same bit for bit.
double motion_difference(const Shot& a, const Shot& b, const std::string& global,
                         bool* exact = nullptr);

/// Every key and every value without keys of a file's rigs and orphans: one line for each, that
/// names the rig, what it belongs to, the clip, the times and the values.
std::vector<std::string> keys_of(const Shot& shot);

/// Builds the rigs of a file again in place, or takes them apart, with the modules that come with
/// rigc; checks that it did not fail.
pipeline::Rebuilt rebuild(const std::string& path, const pipeline::RebuildRequest& request = {});
pipeline::Rebuilt unbuild(const std::string& path);

/// Updates a file in place and gives the result; checks that it did not fail.
pipeline::FileResult update(const std::string& path, const std::string& templates,
                            pipeline::UpdateSettings settings = {});

}  // namespace rigc::test
