// SPDX-License-Identifier: MIT
// Compares how two rigs play. Test: tests/update/verify_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "base/diagnostics.h"
#include "scene/scene.h"

namespace rigc::update {

/// A rig, and where its nodes are.
struct Player {
  const scene::Scene* scene = nullptr;      ///< with what animators set
  const std::vector<int>* nodes = nullptr;  ///< glTF node of each scene node
};

/// A clip as it plays on the old rig and on the new one.
struct ClipPair {
  const anim::Clip* old = nullptr;
  const anim::Clip* fresh = nullptr;
};

/// A joint of both rigs.
struct JointPair {
  std::string name;
  scene::NodeId old, fresh;
};

struct Difference {
  std::string joint;
  double largest_mm = 0, mean_mm = 0;
  double largest_degrees = 0, mean_degrees = 0;
};

struct Comparison {
  std::size_t times = 0;      ///< that were compared
  std::size_t all_times = 0;  ///< keys, and midway between them
  std::vector<Difference> joints;
};

/// Most times of a clip that are compared.
inline constexpr std::size_t kMostTimes = 2000;

/// Evaluates both for each pair of clips at their keys and midway, evenly thinned to kMostTimes; a
/// clip without keys is compared once. Each rig is compiled once. `unit`: length in rig space of a
/// metre. A rig that cannot be evaluated is reported.
std::optional<std::vector<Comparison>> compare(const Player& old, const Player& fresh,
                                               const std::vector<ClipPair>& clips,
                                               const std::vector<JointPair>& joints, double unit,
                                               Diagnostics& diagnostics);

}  // namespace rigc::update
