// SPDX-License-Identifier: MIT
// Bake: a clip on controls becomes a clip on joints. Test: tests/bake/bake_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "anim/clip.h"
#include "base/diagnostics.h"
#include "base/threads.h"
#include "scene/scene.h"

namespace rigc::bake {

/// Where a node stands in its file, which may differ from the scene: a model's joint keeps its
/// parent and the transform that its author left it in.
struct Standing {
  scene::NodeId base;    ///< nearest node of the rig above it in the file; invalid: the rig's space
  math::Affine between;  ///< from the base (or the rig's space) to the node's parent in the file
  math::Trs local;       ///< of the node in the file: what plays where it has no channel
  /// Where nodes of the file below it stand that are not the rig's, in its space: they move with
  /// it, and key reduction must not move them too far either.
  std::vector<math::Vec3> points = {};
};

struct Options {
  /// Frames a second; 0: the union of the keys' times, with a frame right before each step and,
  /// where there is a tolerance, as many between as playing needs to stay within it.
  double fps = 30;
  /// Seconds; else the clip's.
  std::optional<double> start, end;
  /// Largest world-space error of any joint (rig units) that key reduction may cause, at any time
  /// between the frames too; 0: every frame of a channel that moves is a key.
  double tolerance = 0;
  /// By scene node; empty: every node stands where the scene's rest has it.
  std::vector<Standing> standings;
  /// The controls keep their channels in the baked file (`--keep-rig`).
  bool controls_play = false;
  /// What evaluates ranges of frames; null: the caller's thread alone. The result is the same.
  Threads* threads = nullptr;
};

/// What translation, rotation and scale cannot express of a joint: under a non-uniform scale it can
/// be sheared.
struct Shear {
  double relative = 0;  ///< largest entry that is lost of a matrix, in sizes of the joint
  double distance = 0;  ///< how far points at the length of the limb are off, rig units
  scene::NodeId joint;  ///< where and when they are farthest off
  double seconds = 0;

  void add(const Shear& other);
};

struct Report {
  std::size_t frames = 0;
  std::vector<float> times;  ///< of the frames of the last clip, seconds
  std::size_t channels = 0;
  std::size_t keys = 0;
  Shear shear;                 ///< the largest of any clip
  double reduction_error = 0;  ///< largest world-space error after reduction, rig units
  /// glTF nodes that the result speaks for, with a channel or without: others on them do not count.
  std::vector<int> driven;
};

/// `nodes`: glTF node of each scene node (-1: none). Channels of `clip` on nodes of the scene are
/// evaluated, others ignored, and so are those on attributes that the rig drives. The result has
/// channels only where a joint moves against what stands in its file, a channel that never changes
/// as one key; quaternions continuous. Joints that nothing drives keep the channels of their own
/// that they may have.
std::optional<anim::Clip> bake(const scene::Scene& scene, const std::vector<int>& nodes,
                               const anim::Clip& clip, const Options& options, Report& report,
                               Diagnostics& diagnostics);

}  // namespace rigc::bake
