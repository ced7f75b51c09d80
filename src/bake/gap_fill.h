// SPDX-License-Identifier: MIT
// How far one motion is from another at keys and between them, and keys put where it is too far.
// Test: tests/bake/transfer_test.cpp, tests/bake/match_test.cpp
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "bake/gaps.h"
#include "base/diagnostics.h"
#include "base/threads.h"
#include "scene/scene.h"

namespace rigc::bake {

/// Where a motion is farthest from another.
struct Deviation {
  double distance = 0;                         ///< between the nodes' origins, rig units
  double angle = 0;                            ///< radians
  scene::NodeId farthest, most_turned;         ///< invalid: none at all
  double farthest_at = 0, most_turned_at = 0;  ///< seconds
};

/// Of one node at a time.
Deviation deviation(scene::NodeId node, const math::Affine& wanted, const math::Affine& got,
                    double seconds);

void keep_larger(const Deviation& one, Deviation& largest);

/// How far off nodes are at the ends of a gap between two keys, and at three times in it.
struct GapOff {
  Deviation at_ends, inside;
  /// How far a node, or a point at the length of its limb from it, is off in it beyond what it is
  /// at its ends, rig units.
  double excess = 0;
};

/// Indices of all gaps between times: gap i lies between times i and i + 1. One time alone counts
/// as a gap too.
std::vector<std::size_t> all_gaps(const std::vector<double>& times);

/// Times at which a gap is looked at: its ends, and inside.
inline constexpr std::size_t kGapTimes = Gap::kInside + 2;

/// Those of gaps number `first` to `last` of a list, kGapTimes for each, rising.
std::vector<double> times_in(const std::vector<std::size_t>& gaps, std::size_t first,
                             std::size_t last, const std::vector<double>& times);

/// `compare` adds a frame's deviation and gives how far off it is; `frame`: of the gap's begin.
GapOff measure_gap(const std::function<double(std::size_t, Deviation&)>& compare,
                   std::size_t frame);

/// Runs over the gaps of a list, those from one number to another at a time, in threads; false
/// where something was reported.
bool for_gaps(std::size_t count, Threads& threads, Diagnostics& diagnostics,
              const std::function<void(std::size_t first, std::size_t last, Diagnostics&)>& run);

/// Which gaps are halved.
struct Filling {
  /// Those that are off by more, rig units. Infinite: none.
  double tolerance = std::numeric_limits<double>::infinity();
  double shortest = Gap::kShortest;  ///< but none that are shorter, seconds
};

/// Measures all gaps between `times`, and halves them as asked until none is left. `measure` fills
/// what those gaps of all are off by; `add` solves at more times and puts them among `times`. False
/// where one of them failed.
bool fill_gaps(const std::vector<double>& times, const Filling& filling, std::vector<GapOff>& off,
               const std::function<bool(const std::vector<std::size_t>& gaps,
                                        std::vector<GapOff>& off)>& measure,
               const std::function<bool(const std::vector<double>& more)>& add);

}  // namespace rigc::bake
