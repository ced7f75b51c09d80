// SPDX-License-Identifier: MIT
// What single words of bone names say about a template's joints: the words that a map knows for
// them, and their own groups and labels. Only for map_guess.cpp.
// Test: tests/templates/map_guess_test.cpp
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "templates/map.h"

namespace rigc::templates {

class GuessWords {
 public:
  /// `map` is one with `names: words`; its sides and ignored words are used for all names.
  GuessWords(const Map& map, const Expanded& expanded, const tags::ForeignSkeleton& skeleton);

  /// The word of a bone's name that speaks for a joint, or for its limb; empty: none.
  std::string speaking(std::size_t joint, std::size_t bone) const;
  /// Above 0 where words speak for a joint, below where they speak for another limb.
  double score(std::size_t joint, std::size_t bone) const;
  /// `l`, `r` or empty.
  const std::string& side(std::size_t bone) const { return sides_[bone]; }

 private:
  std::vector<std::set<std::string>> joint_words_;  ///< by expanded joint
  std::vector<std::string> limbs_;                  ///< by expanded joint: its group without side
  std::map<std::string, std::set<std::string>> limbs_of_;  ///< by word
  std::vector<std::vector<std::string>> bone_words_;
  std::vector<std::string> sides_;
};

}  // namespace rigc::templates
