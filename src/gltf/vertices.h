// SPDX-License-Identifier: MIT
// Vertices of a file's meshes with what moves them.
// Test: tests/gltf/vertices_test.cpp
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "gltf/file.h"
#include "gltf/slim.h"
#include "math/math.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// Vertices of one primitive that one skin moves, or that ride on a node.
struct SkinnedVertices {
  std::vector<int> joints;            ///< nodes of the skin; without one the mesh's and all above
  std::vector<math::Affine> inverse;  ///< their inverse bind matrices
  std::vector<math::Vec3> places;     ///< [vertices], in the space of the mesh
  std::size_t slots = 0;              ///< influences of a vertex
  std::vector<float> used;            ///< [vertices][slots]: index into joints
  std::vector<float> weights;         ///< the same
};

/// Every skinned primitive of a file, each once for each skin, then the surfaces of meshes without
/// one. What is compressed, damaged or has weights outside of the skin is left out.
/// `without`: nodes whose meshes do not count.
std::vector<SkinnedVertices> read_vertices(const File& file, const std::set<int>& without = {});

/// Looks into `file`, which must outlive it; reads it at the first use. Not for several threads at
/// once. `without`: as above.
tags::Geometry geometry_of(const File& file, std::set<int> without = {});

/// Inverse bind matrices of a skin's joints; empty where they cannot be read.
std::vector<math::Affine> inverse_binds(const File& file, const Slim& slim, const SlimSkin& skin);
/// A node and all above it, each with what leads from the first one's space into its own.
std::vector<std::pair<int, math::Affine>> ways_up(const Slim& slim, int node);

}  // namespace rigc::gltf
