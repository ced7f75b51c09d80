// SPDX-License-Identifier: MIT
// A clip that moves every control of a rig, baked, and where the rig itself has its joints then.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/bake_file.h"
#include "pipeline/motion_helpers.h"

namespace rigc::test {

/// A rig file of which every control is keyed for a second, off the grid of frames.
struct Wiggle {
  Rigged rigged;
  std::string name;   ///< of the clip
  std::string keyed;  ///< path
};

/// Keys `NAME_rig.glb` into `NAME_wiggle.glb`: in a clip of its own, or in the model's first clip
/// that moves morph weights.
Wiggle wiggle(Rigged rigged, const std::string& name, std::uint64_t seed);

/// Bakes into `NAME`; fails the test on an error.
pipeline::Baked bake_wiggle(const Wiggle& wiggle, const std::string& out,
                            const pipeline::BakeRequest& settings = {});

/// A joint that the rig drives, and its world matrix by time as the rig itself is evaluated.
struct DrivenJoint {
  std::size_t node;  ///< glTF
  std::string name;
  std::vector<math::Affine> worlds;
};
/// `spaces`: by time, where the rig's space lies in the world.
std::vector<DrivenJoint> evaluate_joints(const Wiggle& wiggle, const std::vector<double>& seconds,
                                         const std::vector<math::Affine>& spaces);

/// Where the rig's space lies in worlds of a file's nodes, by time.
std::vector<math::Affine> spaces_of(const Wiggle& wiggle,
                                    const std::vector<std::vector<math::Affine>>& worlds);

/// `count` times a second from 0 to 1, each a 32-bit float as glTF has them.
std::vector<double> times_at(int count);

/// How far two worlds of a joint are apart: the origin, and points on the axes at `limb`.
double apart(const math::Affine& a, const math::Affine& b, double limb);

}  // namespace rigc::test
