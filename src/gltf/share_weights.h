// SPDX-License-Identifier: MIT
// Shares what is weighted to a bone's joint among joints along the bone.
// Test: tests/gltf/share_weights_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/math.h"

namespace rigc::gltf {

/// One bone, or a line that stands for one. Joints are indices into the skin's list.
struct Sharing {
  std::size_t joint = 0;  ///< whose weights are shared
  /// How far along the bone a vertex lies, 0..1: dot(along, position) + begin, in the space of the
  /// mesh's positions.
  math::Vec3 along;
  double begin = 0;
  struct Stop {
    double fraction = 0;
    std::size_t joint = 0;
  };
  std::vector<Stop>
      stops;  ///< rising; at each a weight is all its joint's, between two it is both's
  /// Points in the space of the mesh's positions, none or more than one, of a line in place of the
  /// bone: a vertex lies as far along it as the nearest of its points, in parts of its length.
  std::vector<math::Vec3> line = {};
};

/// Influences on the vertices of a primitive.
struct VertexWeights {
  std::size_t slots = 4;              ///< of a vertex: four for each JOINTS_n and WEIGHTS_n
  std::vector<std::uint16_t> joints;  ///< [vertices][slots]
  std::vector<float> weights;         ///< the same; 0 in slots without a use
  bool whole = false;                 ///< weights are whole numbers, of which a sum stays whole
};

/// Shares weights among the joints of each bone; a vertex's sum stays, and what is weighted to
/// other joints too. Where a vertex has too few slots all get four more, and its largest influences
/// stand in the first; where those are too few, its least influences join the largest. `positions`:
/// [vertices][3]. Gives by bone whether any weight was shared.
std::vector<bool> share(VertexWeights& vertices, const std::vector<float>& positions,
                        const std::vector<Sharing>& bones);

}  // namespace rigc::gltf
