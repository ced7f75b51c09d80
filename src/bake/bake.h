// SPDX-License-Identifier: MIT
// Bake: a clip on controls becomes a clip on joints. Test: tests/bake/bake_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "anim/clip.h"
#include "base/diagnostics.h"
#include "scene/scene.h"

namespace rigc::bake {

struct Options {
  double fps = 30;                          ///< 0: the union of the keys' times
  std::optional<double> start, end;         ///< seconds; else the clip's
  double tolerance = 0;                     ///< largest world-space error of any joint (rig units) that key reduction may cause; 0: only exact repeats are dropped
};

struct Report {
  std::size_t frames = 0;
  std::size_t channels = 0;
  std::size_t keys = 0;
  double shear = 0;                         ///< largest relative error where TRS cannot express a joint
  double reduction_error = 0;               ///< largest world-space error of a joint after reduction, rig units
};

/// `nodes`: glTF node of each scene node (-1: none). Channels of `clip` on nodes of the scene are evaluated, others ignored.
/// The result has channels only where a joint moves against its rest, a channel that never changes as one key; quaternions continuous.
std::optional<anim::Clip> bake(const scene::Scene& scene, const std::vector<int>& nodes, const anim::Clip& clip,
                               const Options& options, Report& report, Diagnostics& diagnostics);

}  // namespace rigc::bake
