// SPDX-License-Identifier: MIT
// Capsules, boxes and cylinders around bones as triangles. Test: tests/gltf/proxy_mesh_test.cpp
#pragma once

#include <cstdint>
#include <vector>

#include "math/math.h"

namespace rigc::gltf {

/// Numbers as in scene::mesh::kParts.
enum class ProxyStyle : std::uint8_t { capsule = 0, box = 1, cylinder = 2 };

/// One piece of a proxy mesh, in the space of its joint.
struct ProxyPart {
  ProxyStyle style = ProxyStyle::capsule;
  math::Vec3 head, tail;     ///< ends of the bone
  math::Vec3 side{1, 0, 0};  ///< unit, direction of `width`
  double width = 0;          ///< full extents across the bone
  double depth = 0;
  math::Vec3 color;  ///< sRGB 0..1
};

/// Triangles with outward normals, counter-clockwise seen from outside.
struct Surface {
  std::vector<math::Vec3> points;
  std::vector<math::Vec3> normals;  ///< unit, one for each point
  std::vector<std::uint32_t> indices;
};

Surface surface(const ProxyPart& part);

}  // namespace rigc::gltf
