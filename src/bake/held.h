// SPDX-License-Identifier: MIT
// Controls that go along with a limb's controls, as a shoulder does, and that shall stay where they
// are while the limb is keyed otherwise. Test: tests/bake/match_test.cpp
#pragma once

#include "bake/clip_frames.h"

namespace rigc::bake {

class Held {
 public:
  /// `frames` outlive it.
  Held(const scene::Scene& scene, ClipFrames& frames, std::vector<scene::NodeId> controls)
      : scene_(scene), frames_(frames), controls_(std::move(controls)) {}

  /// They shall stay where they are now. False where that cannot be computed (reported).
  bool note();
  /// Sets their values so that they are there again, in the numbers of a file: those of controls
  /// that left, whatever moved them.
  bool hold();

  const std::vector<scene::Plug>& written() const { return written_; }

 private:
  std::vector<scene::Plug> plugs(std::uint16_t attribute) const;
  void set(scene::NodeId control, const std::vector<double>& parents,
           const std::vector<double>& worlds);

  const scene::Scene& scene_;
  ClipFrames& frames_;
  std::vector<scene::NodeId> controls_;
  Rows wanted_;  // worlds
  std::vector<scene::Plug> written_;
};

/// The local transform that keeps a world under each of its parents, in the numbers of a file:
/// translations and rotations, [frames][3] and [frames][4], these continuous from `before` on.
struct Kept {
  std::vector<double> places, turns;
};
Kept kept(const std::vector<double>& worlds, const std::vector<double>& parents, std::size_t frames,
          math::Quat before);

}  // namespace rigc::bake
