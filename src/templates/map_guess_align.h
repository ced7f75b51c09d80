// SPDX-License-Identifier: MIT
// Aligning two trees of joints: a template's, in its own proportions, and a model's. Both
// hierarchies must agree where they can; what two joints have in common is how their bones lie, and
// what names say. Only for map_guess.cpp. Test: tests/templates/map_guess_test.cpp
#pragma once

#include <functional>
#include <vector>

#include "math/math.h"

namespace rigc::templates {

/// Parents first is not promised; -1: no parent.
struct AlignNode {
  int parent = -1;
  math::Vec3 at;
  double weight = 0;  ///< of a template's joint: what it costs to leave it without a bone
};

struct AlignInput {
  std::vector<AlignNode> joints;  ///< of the template: left +X, up +Y, forward +Z
  std::vector<AlignNode> bones;   ///< of the model, in the world
  std::function<double(std::size_t joint, std::size_t bone)> names;  ///< what names speak for
  math::Vec3 left;  ///< in the world, as names have it; zero: they do not say
};

struct Alignment {
  std::vector<int> bone_of;  ///< by joint; -1: none
  std::vector<bool>
      detached;      ///< by joint: its bone was found by its place, not below its parent's
  math::Mat3 axes;   ///< left, up, forward of the model in the world
  double scale = 1;  ///< world lengths of a template's metre
  double score = 0;
};

/// The best alignment over the ways in which a character can stand along the world's axes.
Alignment align(const AlignInput& input);

}  // namespace rigc::templates
