// SPDX-License-Identifier: MIT
// Makes channels of a motion: which of a joint's translation, rotation and scale need one, and with
// how many keys. Test: tests/bake/bake_test.cpp
#pragma once

#include <vector>

#include "anim/clip.h"
#include "bake/motion.h"

namespace rigc::bake {

/// A channel to be, with one value for each frame as glTF will hold it.
struct Track {
  std::size_t body = 0;
  anim::Path path = anim::Path::translation;
  int width = 3;
  std::vector<float> values;        ///< [frames][width]; of a constant track [1][width]
  std::vector<std::uint32_t> keys;  ///< frames that become keys, rising; empty: all
  bool constant = false;
};

/// Tracks that are needed: a joint's value differs from what stands in its file, by more than the
/// noise of 32-bit floats.
std::vector<Track> find_tracks(const scene::Scene& scene, const std::vector<Body>& bodies,
                               const Motion& motion, Threads& threads);

/// `times`: of all frames, shared by the channels that have all keys.
anim::Curve curve_of(const Track& track, const std::shared_ptr<const std::vector<float>>& times);

}  // namespace rigc::bake
