// SPDX-License-Identifier: MIT
// Frames of a clip: what is set in each, and what the rig makes of it, in double.
// Test: tests/bake/match_test.cpp, tests/pipeline/morphs_test.cpp
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "anim/clip.h"
#include "base/diagnostics.h"
#include "scene/scene.h"

namespace rigc::bake {

/// Of several plugs, in their order: [frames][width] each.
using Rows = std::vector<std::vector<double>>;

/// A world in a frame.
math::Affine affine(const std::vector<double>& row, std::size_t frame);

class ClipFrames {
 public:
  /// `times`: seconds, outlive it as the others do.
  ClipFrames(const scene::Scene& scene, const std::vector<double>& times, Diagnostics& diagnostics)
      : scene_(scene), times_(times), diagnostics_(diagnostics) {}

  std::size_t count() const { return times_.size(); }
  /// Puts what a clip plays into the table.
  void sample(const std::vector<int>& nodes, const anim::Clip& clip);
  /// Evaluates plugs with all that the table says.
  std::optional<Rows> evaluate(const std::vector<scene::Plug>& plugs) const;

  std::map<scene::Plug, std::vector<double>> table;  ///< values of plugs, [frames][width] each
  std::set<scene::Plug> keyed;                       ///< by the clip

 private:
  const scene::Scene& scene_;
  const std::vector<double>& times_;
  Diagnostics& diagnostics_;
};

}  // namespace rigc::bake
