// SPDX-License-Identifier: MIT
// The joints' motion that a transfer must give back: what a clip plays in its file without the rig.
// Test: tests/bake/transfer_test.cpp
#pragma once

#include <vector>

#include "anim/clip.h"
#include "bake/bake.h"

namespace rigc::bake {

/// What a joint may have channels for.
inline constexpr anim::Path kPaths[] = {anim::Path::translation, anim::Path::rotation,
                                        anim::Path::scale};

/// One joint of the rig that has a place in the file.
struct Aim {
  scene::NodeId id;
  int base = -1;       ///< index in the list, smaller than its own; -1: the rig's space
  bool direct = true;  ///< its transform in the file is the scene's: same parent, nothing between
  Standing standing;
  const anim::Curve* translation = nullptr;  ///< of the clip
  const anim::Curve* rotation = nullptr;
  const anim::Curve* scale = nullptr;
  bool animated() const { return translation || rotation || scale; }
};

/// Null: the clip has none.
const anim::Curve* curve_on(const Aim& aim, anim::Path path);

/// Whether the rig or the transfer says where a joint is: then its channels go, or come again.
bool is_solved(const scene::Scene& scene, const Aim& aim);

/// Joints of the skeleton, bases first; `clip` outlives them.
std::vector<Aim> find_aims(const scene::Scene& scene, const std::vector<int>& nodes,
                           const anim::Clip& clip, const std::vector<Standing>& standings);

/// What a joint plays, seen from its parent in the file.
math::Trs local_at(const Aim& aim, double seconds);

/// Worlds in the rig's space, [aims][times].
std::vector<std::vector<math::Affine>> play(const std::vector<Aim>& aims,
                                            const std::vector<double>& times);

/// Largest difference of a number in two transforms' translations, rotations or scales.
double differ(const math::Trs& a, const math::Trs& b, anim::Path path);

/// The same between a transform and what a joint plays, at its keys (and between cubic ones).
double largest_difference(const Aim& aim, anim::Path path, const math::Trs& local);

/// What counts as rounding in a node's numbers.
class Noise {
 public:
  Noise(const scene::Scene& scene, const std::vector<Aim>& aims);
  double of(scene::NodeId id, anim::Path path) const;

 private:
  const scene::Scene& scene_;
  double size_ = 0;  ///< how far a joint rests from the origin
};

}  // namespace rigc::bake
