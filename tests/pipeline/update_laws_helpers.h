// SPDX-License-Identifier: MIT
// What the laws of updates share: shots whose templates are edited at random, and what of a shot is
// in another one.
#pragma once

#include <cstdint>
#include <string>

#include "pipeline/shot_helpers.h"
#include "support/random_edits.h"

namespace rigc::test {

/// Edits that turn the axes of controls, too.
EditOptions turning(bool turns = true);

/// A shot whose template is edited.
struct EditedShot {
  std::string folder, shot;
  EditedTemplate now;
  Random random;
  std::string edits;  ///< what was done, for messages

  /// Built and animated.
  EditedShot(const std::string& name, std::uint64_t seed, const EditOptions& options,
             const Animation& animation = {});
  /// A version with some edits.
  void publish(std::size_t count);
  pipeline::FileResult update(pipeline::UpdateSettings settings = {});
  void go_to(const EditedTemplate& other) { now = other.returning_from(now); }
};

/// How much a shot keeps, without the switches of limbs: where a limb takes a chain's place, rigc
/// sets its switch, and keeps how it stood.
std::size_t count_of(const Shot& shot);
/// What of a shot another one does not have; with `turns` its axes may differ.
std::string lost(const Shot& before, const Shot& after, bool turns);
/// Whether a file reads without a word.
bool is_clean(const std::string& path);
std::string orphans_of(const Shot& shot);
std::size_t orphans_in(const Shot& shot);
/// Largest difference of the numbers of keys and values that belong to the same nodes.
double number_difference(const Shot& a, const Shot& b);

}  // namespace rigc::test
