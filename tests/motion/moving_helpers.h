// SPDX-License-Identifier: MIT
// Shipped templates built in memory, all of whose controls can be moved, evaluated block by block.
// Test: tests/motion/continuity_test.cpp
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eval/evaluate.h"
#include "gltf/rig.h"

namespace rigc::test {

/// What an animator can key: translate, rotation and scale of controls, and their own attributes.
struct Keyable {
  enum class What { translate, rotation, scale, number };
  scene::Plug plug;
  What what;
  std::string name;          ///< `arm_l.settings@ik_fk`: for messages
  double low = 0, high = 0;  ///< of a number: its range
  bool whole = false;        ///< of a number: it counts, such as the number of a space
  std::vector<double> rest;
};

class Moving {
 public:
  /// `file`: below templates/, as `biped.yaml`.
  explicit Moving(const std::string& file);

  const std::string& name() const { return name_; }
  const scene::Scene& scene() const { return scene_; }
  const std::vector<Keyable>& keyables() const { return keyables_; }
  const std::vector<scene::NodeId>& joints() const { return joints_; }
  /// Inputs are the keyables, outputs the joints' worlds.
  const eval::Program& program() const { return *program_; }
  /// Largest distance of any joint from the first at rest, metres.
  double size() const { return size_; }

  /// Fills the numbers of keyable `index` in a frame.
  using Values = std::function<void(std::size_t index, std::size_t frame, std::vector<double>&)>;
  /// Worlds of all joints, 12 numbers each, frame by frame. Frame f lies in lane (f + shift) %
  /// kLanes of its block.
  std::vector<std::vector<double>> worlds(std::size_t frames, const Values& values,
                                          std::size_t shift = 0) const;

 private:
  void add_keyables(scene::NodeId control);

  std::string name_;
  scene::Scene scene_;
  std::vector<Keyable> keyables_;
  std::vector<scene::NodeId> joints_;
  std::optional<eval::Program> program_;
  double size_ = 0;
};

}  // namespace rigc::test
