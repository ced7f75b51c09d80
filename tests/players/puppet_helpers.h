// SPDX-License-Identifier: MIT
// A baked file as rigc plays it, in double precision: worlds of nodes, vertices after morphing and
// skinning. What other people's players show is compared with it.
#pragma once

#include <string>
#include <vector>

#include "gltf/slim.h"
#include "math/math.h"

namespace rigc::test {

/// A primitive of a mesh that a node shows.
struct ShownPrimitive {
  int node = -1;  ///< glTF
  int primitive = 0;
  std::vector<math::Vec3> points;                   ///< [vertices], as they are stored
  std::vector<std::vector<math::Vec3>> targets;     ///< [morph targets][vertices]
  std::vector<std::vector<float>> joints, weights;  ///< [vertices][4]; empty: not skinned
  std::vector<bool> used;                           ///< [vertices], by its indices
};

class Puppet {
 public:
  Puppet(const std::string& path, const std::string& clip);

  /// Worlds of all nodes, by time.
  std::vector<std::vector<math::Affine>> worlds(const std::vector<double>& seconds) const;
  const std::vector<ShownPrimitive>& primitives() const { return primitives_; }
  /// Where the vertices of a primitive are, given the worlds of the nodes.
  std::vector<math::Vec3> vertices(const ShownPrimitive& primitive,
                                   const std::vector<math::Affine>& worlds, double seconds) const;
  /// Morph weights that change in the clip.
  std::size_t moving_weights() const { return weight_curves_.size(); }

 private:
  void read_primitive(const json::Value& json, ShownPrimitive& out) const;
  std::vector<math::Vec3> read_points(const json::Value& accessor) const;
  std::vector<float> read(const json::Value& accessor, std::size_t& width) const;
  void read_weights(const std::string& clip);
  std::vector<double> weights_of(int node, std::size_t count, double seconds) const;

  std::string path_, clip_;
  std::optional<gltf::File> file_;
  std::optional<gltf::Slim> slim_;
  std::vector<ShownPrimitive> primitives_;
  struct WeightCurve {
    int node;
    anim::Curve curve;
  };
  std::vector<WeightCurve> weight_curves_;
  std::vector<std::vector<math::Affine>> inverse_binds_;  // by skin
};

}  // namespace rigc::test
