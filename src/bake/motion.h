// SPDX-License-Identifier: MIT
// Evaluates a clip on a scene: how each body moves in the baked file.
// Test: tests/bake/bake_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/bodies.h"
#include "base/threads.h"
#include "eval/clip_inputs.h"
#include "eval/program.h"

namespace rigc::bake {

/// A value for each frame, or one for all.
template <class T>
struct Series {
  std::vector<T> values;
  const T& operator[](std::size_t frame) const { return values[values.size() == 1 ? 0 : frame]; }
  bool is_constant() const { return values.size() == 1; }
};

/// A body's transform, relative to the node's parent in the file.
struct Moves {
  Series<math::Vec3> translation;
  Series<math::Quat> rotation;  ///< of length 1, no two neighbours more than a half turn apart
  Series<math::Vec3> scale;

  math::Trs operator[](std::size_t frame) const {
    return {translation[frame], rotation[frame], scale[frame]};
  }
};

struct Motion {
  std::vector<double> times;  ///< seconds, [frames]
  std::vector<Moves> bodies;
  Shear shear;  ///< the largest
};

/// Numbers that a Motion holds for each body and frame, at most: translation, rotation, scale.
inline constexpr std::size_t kMotionWidth = 10;

/// A scene compiled for what a bake wants to know of it.
class Evaluator {
 public:
  /// All outlive it.
  static std::optional<Evaluator> make(const scene::Scene& scene, const std::vector<Body>& bodies,
                                       const std::vector<eval::ClipInput>& inputs,
                                       const std::vector<Reach>& reaches, Diagnostics& diagnostics);
  std::optional<Motion> run(std::vector<double> times, Threads& threads,
                            Diagnostics& diagnostics) const;

  const std::vector<Body>& bodies() const { return *bodies_; }
  const std::vector<Reach>& reaches() const { return *reaches_; }
  /// Numbers that a bake keeps for each frame, at most.
  std::size_t width() const { return bodies_->size() * kMotionWidth; }

 private:
  friend class RangeWorker;
  Evaluator(const scene::Scene& scene, const std::vector<Body>& bodies,
            const std::vector<eval::ClipInput>& inputs, const std::vector<Reach>& reaches);
  eval::Request request();
  void find_what_varies();
  void prepare(Motion& motion, struct Found& found) const;

  const scene::Scene* scene_;
  const std::vector<Body>* bodies_;
  const std::vector<eval::ClipInput>* inputs_;
  const std::vector<Reach>* reaches_;  // by body
  eval::Program program_;
  struct Plan {
    std::size_t output = 0;    ///< its first of the program's
    bool varies[3] = {};       ///< translation, rotation, scale change from frame to frame
    bool is_followed = false;  ///< others need its world
  };
  std::vector<Plan> plans_;  ///< by body
};

/// Worlds of all bodies in one frame, rig space.
std::vector<math::Affine> worlds_at(const std::vector<Body>& bodies, const Motion& motion,
                                    std::size_t frame);

}  // namespace rigc::bake
