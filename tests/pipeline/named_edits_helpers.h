// SPDX-License-Identifier: MIT
// Stories of a shot whose template is edited: built, animated, updated, looked at. Templates are
// texts, or edited copies of those that come with rigc.
#pragma once

#include <string>
#include <vector>

#include "pipeline/shot_helpers.h"

namespace rigc::test {

/// One change of a template's text; the old text must be there.
struct TextEdit {
  std::string file;  ///< `biped.yaml`, `parts/arm.yaml`
  std::string from, to;
};

/// Copies the biped with its parts into a folder, with a version and these edits.
void write_biped(const std::string& folder, int version, const std::vector<TextEdit>& edits = {});
std::string replaced(std::string text, const std::string& from, const std::string& to);
/// The clavicle's joint in the arm's template, as an edit that takes it out.
std::vector<TextEdit> without_clavicle();

/// Rounding of joints whose place is computed anew, in heights of the character.
inline constexpr double kRounding = 1e-12;
/// The same where keys are converted, which are floats.
inline constexpr double kConverted = 1e-6;

/// A template of a chest with an arm that FK controls turn, or a limb that has FK and IK.
std::string fk_arm(int version);
std::string ik_fk_arm(int version);
scene::NodeId control(const gltf::Rig& rig, const std::string& local, const std::string& label,
                      const std::string& role);

/// A shot in a folder of its own, with the templates beside it.
struct Story {
  std::string folder, shot;
  Shot original;       ///< before the first update
  Shot before, after;  ///< the last one
  pipeline::FileResult result;

  explicit Story(const std::string& name);
  /// `main.yaml` there, built and animated.
  void build(const std::string& main, unsigned seed, const Animation& animation = {});
  void build_text(const std::string& text, unsigned seed, const Animation& animation = {});
  void update(pipeline::UpdateSettings settings = {});
  void update_text(const std::string& text);
  std::size_t orphans() const;
  /// Rules by which keys and values went elsewhere, sorted, without repetitions.
  std::string rules() const;
};

/// Lines that only one of two lists has; empty: none.
std::string differences(const std::vector<std::string>& a, const std::vector<std::string>& b);

}  // namespace rigc::test
