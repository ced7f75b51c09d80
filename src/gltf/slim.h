// SPDX-License-Identifier: MIT
// Nodes, skins, animations, accessors and buffer views of a checked file as plain structs: the part
// of glTF that rigc must understand. Test: tests/gltf/clips_test.cpp, tests/gltf/skeletons_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "gltf/file.h"
#include "math/math.h"

namespace rigc::gltf {

struct SlimNode {
  std::string name;
  int parent = -1;
  std::vector<int> children;
  int mesh = -1, skin = -1, camera = -1;
  math::Trs local;      ///< a matrix is decomposed
  math::Affine matrix;  ///< the same, exactly as given
  math::Affine world;   ///< as the file stands
};

struct SlimSkin {
  std::string name;
  std::vector<int> joints;
  int matrices = -1;  ///< accessor of inverse bind matrices, -1: none
};

struct SlimView {
  int buffer = -1;
  std::uint64_t offset = 0, length = 0, stride = 0;  ///< stride 0: packed
  bool unfilled = false;  ///< an extension leaves the buffer's bytes to a decoder
};

struct SlimAccessor {
  int view = -1;  ///< -1: zeros
  std::uint64_t offset = 0, count = 0;
  int component = 0;  ///< 5120..5126
  int width = 0;      ///< numbers in an element
  bool normalised = false;
  struct Sparse {
    std::uint64_t count = 0;  ///< 0: not sparse
    int index_view = -1, index_component = 0, value_view = -1;
    std::uint64_t index_offset = 0, value_offset = 0;
  } sparse;
};

struct SlimSampler {
  int input = -1, output = -1;
  anim::Interpolation interpolation = anim::Interpolation::linear;
};

/// A channel on a node; channels with a pointer or without a node are not here.
struct SlimChannel {
  int index = 0;  ///< in the file's animation
  int sampler = 0, node = -1;
  std::string path;
};

struct SlimAnimation {
  std::string name;
  std::vector<SlimSampler> samplers;
  std::vector<SlimChannel> channels;
};

struct Slim {
  std::vector<SlimNode> nodes;
  std::vector<SlimSkin> skins;
  std::vector<SlimView> views;
  std::vector<SlimAccessor> accessors;
  std::vector<SlimAnimation> animations;

  std::vector<int> preorder;  ///< all nodes, parents before children, children in order

  const SlimNode& node(int index) const { return nodes[static_cast<std::size_t>(index)]; }
  /// World matrix of a node as the file stands; identity for -1.
  math::Affine world(int index) const { return index < 0 ? math::Affine() : node(index).world; }
};

/// Without `animations`, that part stays empty: it is most of what there is to read in many files.
std::optional<Slim> read_slim(const File& file, Diagnostics& diagnostics, bool animations = true);

}  // namespace rigc::gltf
