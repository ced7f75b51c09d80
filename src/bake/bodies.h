// SPDX-License-Identifier: MIT
// What a bake must follow: the joints that get channels, and what they hang under in the file.
// Test: tests/bake/bodies_test.cpp
#pragma once

#include <vector>

#include "bake/bake.h"

namespace rigc::bake {

/// One node of the file that belongs to the rig.
struct Body {
  /// How its local transform comes about in the baked file.
  enum class Source : std::uint8_t {
    local,    ///< as the scene evaluates it: base and parent are one, and play as the scene does
    world,    ///< so that its world is the scene's, whatever its base does
    standing  ///< it has no channel and stays as it stands
  };
  scene::NodeId id;
  int base = -1;  ///< index in the list, smaller than its own; -1: the rig's space
  math::Affine between;
  math::Trs standing;
  Source source = Source::local;
  bool is_output = false;  ///< gets channels
};

/// Joints that get channels and all they hang under, bases first. `animated`: by scene node,
/// whether the clip has a channel on its transform.
std::vector<Body> find_bodies(const scene::Scene& scene, const std::vector<int>& nodes,
                              const std::vector<bool>& animated, const Options& options);

/// How far a body's own change is felt: lengths in rig units at rest.
struct Reach {
  double limb = 0;  ///< to the farthest base-child, or as long as its own bone, never 0: where its
                    ///< rotation is measured
  double subtree = 0;  ///< to the farthest body below it
  double scale = 1;    ///< of its parent: a unit of its translation in rig units
  /// What moves with it without being a body: joints without channels, nodes that are not the
  /// rig's. In its own space.
  std::vector<math::Vec3> points;
};
std::vector<Reach> reaches(const scene::Scene& scene, const std::vector<int>& nodes,
                           const std::vector<Body>& bodies, const Options& options);

/// World of a body from its local transform and the world of its base (null: the rig's space).
math::Affine world_of(const Body& body, const math::Trs& local, const math::Affine* base);

/// How far apart two worlds of a body are: its origin, its points, and points on its axes as far
/// away as its limb is long.
double distance(const math::Affine& a, const math::Affine& b, const Reach& reach);

}  // namespace rigc::bake
