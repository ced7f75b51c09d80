// SPDX-License-Identifier: MIT
// Match a file: the pose of limbs is carried from FK controls to IK controls, or back, or controls
// are handed to another space, and the switch is keyed. Test: tests/cli/match_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/match_keys.h"
#include "bake/match_space.h"
#include "base/diagnostics.h"
#include "pipeline/transfer.h"

namespace rigc::pipeline {

struct MatchRequest {
  std::string file;
  std::vector<std::string> limbs;  ///< local groups; `all`: every one
  std::string to;                  ///< ik or fk; empty: spaces
  /// Controls that change their space: names of their nodes, or selectors of one each.
  std::vector<std::string> controls;
  std::string space;  ///< that they follow then; empty: limbs
  std::string range;  ///< START:END in seconds, either may be empty; empty: all
  /// Names or numbers; empty: all that key a control of the rigs in question.
  std::vector<std::string> clips;
  std::string fps = "source";  ///< a number, or "source": at the keys' own times
  /// Keys are inserted where joints would be farther off between them, millimetres of a character
  /// of the template's size; with "source" only; 0: none.
  double tolerance_mm = 1;
  Threads* threads = nullptr;  ///< for measuring; null: the caller's thread alone
};

struct MatchedLimb {
  std::string limb;  ///< or the control
  bake::MatchReport report;
  Off at_keys, between;
};

struct MatchedClip {
  std::string name;
  bool passed_through = false;  ///< it keys no control
  std::vector<MatchedLimb> limbs;
};

struct MatchedFile {
  std::vector<MatchedClip> clips;
  std::uint64_t bytes = 0;
};

std::optional<MatchedFile> match_file(const MatchRequest& request, const std::string& out,
                                      Diagnostics& diagnostics);

}  // namespace rigc::pipeline
