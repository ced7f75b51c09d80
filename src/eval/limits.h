// SPDX-License-Identifier: MIT
// What clamps the transforms of a scene: nodes of kind limits, and locked components, which keep
// the value that the scene has. Test: tests/eval/limits_test.cpp
#pragma once

#include <unordered_map>
#include <vector>

#include "base/diagnostics.h"
#include "math/limit.h"
#include "scene/scene.h"

namespace rigc::eval {

struct Limit {
  std::uint16_t attribute;  ///< translate, rotation or scale
  scene::NodeId by;         ///< the limits node; of a lock the transform itself
  math::LimitSpace space;
};

/// A space as the table that limit_vector and limit_rotation take.
std::vector<double> limit_data(const math::LimitSpace& space);

class Limits {
 public:
  /// Limits nodes that make no sense are reported.
  Limits(const scene::Scene& scene, Diagnostics& diagnostics);

  /// In the order in which they count, locks last; null: nothing limits the transform.
  const std::vector<Limit>* of(scene::NodeId transform) const;
  /// Whether anything limits an attribute; `rotate` counts as `rotation`.
  bool apply_to(const scene::Plug& plug) const;

 private:
  void read_limits(const scene::Scene& scene, scene::NodeId node, Diagnostics& diagnostics);
  void read_locks(const scene::Scene& scene, scene::NodeId control);
  std::unordered_map<std::uint32_t, std::vector<Limit>> limits_;  // by index of the transform
};

}  // namespace rigc::eval
