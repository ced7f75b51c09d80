// SPDX-License-Identifier: MIT
// Control shapes as line meshes that any viewer shows; equal ones are written once.
// Test: tests/gltf/control_mesh_test.cpp
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gltf/patch.h"
#include "math/math.h"

namespace rigc::gltf {

class ControlMeshes {
 public:
  explicit ControlMeshes(Patch& patch) : patch_(patch) {}

  /// Index of the mesh of `points` (scene::control::kPoints: count, x, y, z, ... repeated) in an
  /// sRGB colour; -1 where there is no line.
  int mesh(const std::vector<double>& points, const math::Vec3& color, const std::string& name);

 private:
  int material(const math::Vec3& color);
  Patch& patch_;
  std::map<std::string, int> materials_;  ///< by their text
  std::map<std::string, int> meshes_;     ///< by bytes of their points and lines, and material
};

}  // namespace rigc::gltf
