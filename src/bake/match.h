// SPDX-License-Identifier: MIT
// Carries the pose of a limb from its FK controls to its IK controls, and back: by what the rig
// itself says about the limb (scene::match), without knowing how the rig was made.
// Test: tests/bake/match_test.cpp
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "bake/gap_fill.h"
#include "base/diagnostics.h"
#include "scene/scene.h"

namespace rigc::bake {

/// What a node of kind match says.
struct MatchLimb {
  std::string name;
  std::array<scene::NodeId, 3> joints, fk;  ///< start, middle, end
  scene::NodeId ik, pole, solver;
  scene::Plug mode;                                    ///< the switch: 0 FK, 1 IK
  std::map<std::string, scene::Plug, std::less<>> by;  ///< attributes by what they mean
  std::vector<scene::NodeId> held;                     ///< go along with the limb, and stay
};

/// The limbs of a scene whose nodes are complete, in their order.
std::vector<MatchLimb> find_match_limbs(const scene::Scene& scene);

struct MatchOptions {
  bool to_ik = false;
  std::vector<double> times;  ///< seconds, rising, 32-bit floats, at least one: the range
  /// Nothing plays before or after the range.
  bool opens = true, closes = true;
  bool steps = false;  ///< each value holds until the next
};

/// When there are keys.
struct MatchTiming {
  double fps = 0;                    ///< frames a second; 0: the keys' own times
  std::optional<double> start, end;  ///< seconds; else the clip's
  /// Else there is a time right before each step of a curve too.
  bool steps = false;
};

struct MatchReport {
  std::size_t frames = 0;
  std::size_t inserted = 0;            ///< of these, between the clip's own keys
  std::size_t channels = 0, keys = 0;  ///< written
  Deviation at_keys;
  Deviation between;  ///< at three times between each two
};

/// New values of attributes and transforms at the times: what an animator would set by hand.
struct Matched {
  struct Values {
    scene::Plug plug;
    std::vector<double> numbers;  ///< [times][width]
  };
  std::vector<Values> values;  ///< the switch first
};

/// The times at which a clip can be matched: the keys' own from `start` to `end` and these two, or
/// frames. Too many are reported.
std::optional<std::vector<double>> match_times(const scene::Scene& scene,
                                               const std::vector<int>& nodes,
                                               const anim::Clip& clip, const MatchTiming& when,
                                               Diagnostics& diagnostics);

/// Solves in double; each value is rounded to the 32-bit float that a file holds. In IK `pin` and
/// `slide` become 0; `squash` and `soft` become 0 in the range where the pose lies in theirs.
std::optional<Matched> solve_match(const scene::Scene& scene, const std::vector<int>& nodes,
                                   const anim::Clip& clip, const MatchLimb& limb,
                                   const MatchOptions& options, Diagnostics& diagnostics);

/// The clip with keys in the range for what was matched; keys elsewhere stay. The report says how
/// many.
anim::Clip with_keys(const scene::Scene& scene, const std::vector<int>& nodes,
                     const anim::Clip& clip, const Matched& matched, const MatchOptions& options,
                     MatchReport& report);

}  // namespace rigc::bake
