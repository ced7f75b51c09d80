// SPDX-License-Identifier: MIT
// The steps of a fit: which bone is which joint, and what character the matched bones form. Only
// for fit.cpp. Test: tests/templates/fit_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "templates/fit.h"

namespace rigc::templates {

/// The bones of each expanded joint, as indices into ForeignSkeleton::joints: none, one, or those
/// of a chain.
struct Matching {
  std::vector<std::vector<int>> bones;
  std::vector<bool> made;  ///< by expanded joint: rigc makes it, because the model has none
  bool has(std::size_t joint) const { return !bones[joint].empty(); }
};

/// Reports required joints without a bone, and bones that hang otherwise than their joints.
std::optional<Matching> match(const Expanded& expanded, const tags::ForeignSkeleton& model,
                              const Map& map, FitReport& report, Diagnostics& diagnostics,
                              const Bindings* known = nullptr);

/// What was measured, in the model's rig space unless a name says world.
struct Measured {
  tags::Character character;
  math::Vec3 world_left;       ///< unit
  double lowest = 0;           ///< along up, of the matched bones
  double template_lowest = 0;  ///< metres
};

/// Up, left, forward and sizes from the matched bones; `placed` is the template in its own
/// proportions. World axes where the bones do not tell. Reports an asymmetric rest pose.
Measured measure(const Expanded& expanded, const tags::TaggedSkeleton& placed,
                 const tags::ForeignSkeleton& model, const Matching& matching, FitReport& report,
                 Diagnostics& diagnostics);

}  // namespace rigc::templates
