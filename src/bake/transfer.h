// SPDX-License-Identifier: MIT
// Transfer, the reverse of a bake: a clip on joints becomes a clip on the controls that move them.
// Test: tests/bake/transfer_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "bake/bake.h"
#include "bake/gap_fill.h"
#include "base/diagnostics.h"
#include "base/threads.h"
#include "scene/scene.h"

namespace rigc::bake {

/// An attribute that decides whether joints follow FK controls or a solver.
struct Switch {
  scene::Plug attribute;  ///< a keyable user attribute
  double fk = 0, ik = 1;  ///< its values
  std::string group;      ///< local group of the control that has it: "arm_l"
};

/// All switches of a scene, in the order of its nodes.
std::vector<Switch> find_switches(const scene::Scene& scene, Diagnostics& diagnostics);

struct SwitchValue {
  scene::Plug attribute;
  double value = 0;
};

struct TransferOptions {
  /// Frames a second; 0: the union of the keys' times.
  double fps = 0;
  /// Where fps is 0 there are as many keys between the joints' own as it takes for no joint, and no
  /// point at the length of its limb from it, to be farther off between two keys than this (rig
  /// units) beyond what it is at them; 0: none.
  double tolerance = 0;
  /// Seconds; else of the keys on joints.
  std::optional<double> start, end;
  /// As for a bake.
  std::vector<Standing> standings;
  /// Each gets a key. What is not named stays as the scene has it.
  std::vector<SwitchValue> switches;
  /// What evaluates ranges of frames; null: the caller's thread alone. The result is the same.
  Threads* threads = nullptr;
};

struct TransferReport {
  std::size_t joints = 0;  ///< that the clip animates; 0: there was nothing to transfer
  std::size_t frames = 0;
  std::size_t inserted = 0;  ///< of these, between the joints' own keys
  std::size_t controls = 0;  ///< that got keys, switches included
  std::size_t channels = 0;
  std::size_t keys = 0;
  /// Joints that keep channels of their own for what no control says of them.
  std::vector<scene::NodeId> kept;
  std::vector<scene::NodeId> untouched;  ///< joints that nothing of the rig moves: as they were
  std::vector<scene::NodeId> replaced;   ///< controls whose keys of before are gone
  Deviation at_keys;                     ///< of the rig from the joints' own clip
  Deviation between;                     ///< at three times between each two
};

struct Transferred {
  anim::Clip clip;           ///< what comes
  std::vector<int> dropped;  ///< indices of the channels that go, in the file's animation
};

/// `nodes` as for a bake. The joints' motion is what the file plays without its rig; channels on
/// controls that nothing is solved for are taken as they are. A joint's translation or scale that
/// the rig does not drive stays a channel of the joint, where it differs from the rig's.
std::optional<Transferred> transfer(const scene::Scene& scene, const std::vector<int>& nodes,
                                    const anim::Clip& clip, const TransferOptions& options,
                                    TransferReport& report, Diagnostics& diagnostics);

}  // namespace rigc::bake
