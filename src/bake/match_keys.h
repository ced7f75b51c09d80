// SPDX-License-Identifier: MIT
// The keys of a match: when there is one, whether they hold or are joined by lines, and how far the
// rig then is from what it was. Test: tests/bake/match_keys_test.cpp
#pragma once

#include <functional>

#include "bake/match.h"

namespace rigc::bake {

struct MatchTask {
  const scene::Scene& scene;
  const std::vector<int>& nodes;  ///< as for a bake
  const anim::Clip& clip;         ///< what is played now
  const anim::Clip& timing;       ///< whose keys' times count
  MatchTiming when;
  /// Where `when.fps` is 0 there are as many keys between the clip's own as it takes for no joint,
  /// and no point at the length of its limb from it, to be farther off between two keys than this
  /// (rig units) beyond what it is at them; 0: none.
  double tolerance = 0;
  std::vector<scene::NodeId> controls;  ///< that stay too, besides all joints
  std::function<std::optional<Matched>(const MatchOptions&)> solve;
  Threads* threads = nullptr;  ///< for measuring; null: the caller's thread alone
};

/// The clip with the keys. Where all that is solved holds from key to key, so do they.
std::optional<anim::Clip> match_keys(const MatchTask& task, MatchOptions options,
                                     MatchReport& report, Diagnostics& diagnostics);

}  // namespace rigc::bake
